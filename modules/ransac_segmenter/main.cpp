#include "modules/codec/codec.h"
#include "modules/hough_segmenter/hough_segmenter.h"
#include "modules/ransac_segmenter/single_shot.h"
#include "modules/runtime/run.h"

namespace declutter {

class RansacSegmenterModule {
 public:
  using Config = HoughSegmenterConfig;

  RansacSegmenterModule(const Config& config, runtime::Bus& bus)
      : segmenter_(config, FitSidesOnce), hypotheses_(bus.Advertise(kHypotheses)) {
    bus.SubscribeJoined(kTabletop, kFeatures,
                        [this, &bus](const tabletop_t& tabletop, const feature_cloud_t& features) {
                          hypotheses_.Publish(codec::Encode(segmenter_.Segment(
                              codec::Decode(tabletop), codec::Decode(features))));
                          if (!segmenter_.shortfall().empty())
                            bus.Warn("shortfall", segmenter_.shortfall());
                        });
  }

 private:
  HoughSegmenter segmenter_;
  runtime::Publisher<hypothesis_list_t> hypotheses_;
};

}  // namespace declutter

int main(int argc, char** argv) {
  return declutter::runtime::Run<declutter::RansacSegmenterModule>(argc, argv);
}
