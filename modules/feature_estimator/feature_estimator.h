#pragma once

#include "modules/feature_estimator/feature_estimator.pb.h"
#include "modules/geometry/feature_cloud.h"
#include "modules/geometry/tabletop.h"

namespace declutter {

// Normals, curvature, minimum radius (paper mode), horizontal curvature (default mode) and
// connected components of the object points (paper, section 3, steps iii to v).
class FeatureEstimator {
 public:
  explicit FeatureEstimator(const FeatureEstimatorConfig& config);

  // Features of all object points of the tabletop that belong to a component, normals in C.
  FeatureCloud Estimate(const Tabletop& tabletop) const;

 private:
  FeatureEstimatorConfig config_;
};

}  // namespace declutter
