#include "modules/codec/codec.h"
#include "modules/feature_estimator/feature_estimator.h"
#include "modules/runtime/run.h"

namespace declutter {

class FeatureEstimatorModule {
 public:
  using Config = FeatureEstimatorConfig;

  FeatureEstimatorModule(const Config& config, runtime::Bus& bus)
      : estimator_(config), features_(bus.Advertise(kFeatures)) {
    bus.Subscribe(kTabletop, [this](const tabletop_t& tabletop) {
      features_.Publish(codec::Encode(estimator_.Estimate(codec::Decode(tabletop))));
    });
  }

 private:
  FeatureEstimator estimator_;
  runtime::Publisher<feature_cloud_t> features_;
};

}  // namespace declutter

int main(int argc, char** argv) {
  return declutter::runtime::Run<declutter::FeatureEstimatorModule>(argc, argv);
}
