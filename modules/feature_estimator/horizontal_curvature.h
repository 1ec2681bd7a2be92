#pragma once

#include <Eigen/Core>
#include <vector>

#include "modules/feature_estimator/normals.h"
#include "modules/feature_estimator/point_image.h"

namespace declutter {

// [1/m] Signed curvature of side faces in the horizontal plane, convex > 0, element by element of
// the PointImage; 1 / radius on an upright cylinder, 0 on planes and on points not on a side.
//
// Over the side points q within radius_m of p, the component of q's normal along the horizontal
// tangent t at p grows with the offset of q along t; kappa is the slope. A point is on a side when
// its normal is at most max_tilt_rad from horizontal; up_C is the unit normal of the support.
std::vector<float> EstimateHorizontalCurvature(const PointImage& points, const NormalImage& normals,
                                               const Eigen::Vector3d& up_C, double radius_m,
                                               double max_tilt_rad);

}  // namespace declutter
