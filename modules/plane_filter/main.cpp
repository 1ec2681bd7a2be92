#include "modules/codec/codec.h"
#include "modules/plane_filter/plane_filter.h"
#include "modules/runtime/run.h"

namespace declutter {

class PlaneFilterModule {
 public:
  using Config = PlaneFilterConfig;

  PlaneFilterModule(const Config& config, runtime::Bus& bus)
      : filter_(config), tabletop_(bus.Advertise(kTabletop)) {
    bus.Subscribe(kDepthFrame, [this](const depth_frame_t& frame) {
      tabletop_.Publish(codec::Encode(filter_.Filter(codec::Decode(frame))));
    });
  }

 private:
  PlaneFilter filter_;
  runtime::Publisher<tabletop_t> tabletop_;
};

}  // namespace declutter

int main(int argc, char** argv) {
  return declutter::runtime::Run<declutter::PlaneFilterModule>(argc, argv);
}
