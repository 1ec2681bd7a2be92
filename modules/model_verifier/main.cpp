#include "modules/codec/codec.h"
#include "modules/model_verifier/model_verifier.h"
#include "modules/runtime/run.h"

namespace declutter {

class ModelVerifierModule {
 public:
  using Config = ModelVerifierConfig;

  ModelVerifierModule(const Config& config, runtime::Bus& bus)
      : verifier_(config), objects_(bus.Advertise(kObjects)) {
    bus.SubscribeJoined(kDepthFrame, kHypotheses,
                        [this](const depth_frame_t& frame, const hypothesis_list_t& hypotheses) {
                          objects_.Publish(codec::Encode(
                              verifier_.Verify(codec::Decode(frame), codec::Decode(hypotheses))));
                        });
  }

 private:
  ModelVerifier verifier_;
  runtime::Publisher<object_list_t> objects_;
};

}  // namespace declutter

int main(int argc, char** argv) {
  return declutter::runtime::Run<declutter::ModelVerifierModule>(argc, argv);
}
