#pragma once

#include <vector>

#include "modules/feature_estimator/normals.h"
#include "modules/feature_estimator/point_image.h"

namespace declutter {

// [m] Minimum surface radius by the radius-based surface descriptor (paper, section 3, step iv;
// Marton et al. 2010), element by element of the PointImage; plane_radius_m on planes, 0 where the
// normal is unknown.
//
// Two points of a sphere of radius r with normals at angle a are 2 r sin(a / 2) ~ r a apart. Of the
// neighbours within radius_m, the largest angle in each of num_bins distance bins belongs to the
// direction of the smallest radius; r_min is the slope of distance over that angle.
std::vector<float> EstimateMinimumRadius(const PointImage& points, const NormalImage& normals,
                                         double radius_m, int num_bins, double plane_radius_m);

}  // namespace declutter
