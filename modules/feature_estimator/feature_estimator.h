#pragma once

#include "modules/feature_estimator/components.h"
#include "modules/feature_estimator/feature_estimator.pb.h"
#include "modules/feature_estimator/horizontal_curvature.h"
#include "modules/feature_estimator/normals.h"
#include "modules/feature_estimator/point_image.h"
#include "modules/feature_estimator/rsd.h"
#include "modules/geometry/feature_cloud.h"
#include "modules/geometry/tabletop.h"

namespace declutter {

// Normals, curvature, minimum radius (paper mode), horizontal curvature (default mode) and
// connected components of the object points (paper, section 3, steps iii to v).
class FeatureEstimator {
 public:
  explicit FeatureEstimator(const FeatureEstimatorConfig& config);

  // Features of all object points of the tabletop that belong to a component, normals in C. The
  // result is valid until the next call, which uses all memory again.
  const FeatureCloud& Estimate(const Tabletop& tabletop) &;
  FeatureCloud Estimate(const Tabletop& tabletop) && { return Estimate(tabletop); }

 private:
  void EstimateFeatures(const Tabletop& tabletop);
  void FillCloud();

  FeatureEstimatorConfig config_;
  PointImage points_;
  NormalImage normals_;
  CurvatureImage curvature_;  // default mode
  RadiusImage radius_;        // paper mode
  Components components_;
  FeatureCloud cloud_;
};

}  // namespace declutter
