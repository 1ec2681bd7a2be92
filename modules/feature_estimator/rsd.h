#pragma once

#include <vector>

#include "modules/feature_estimator/normals.h"
#include "modules/feature_estimator/point_image.h"

namespace declutter {

struct RsdParameters {
  double radius_m = 0;        // of the neighbourhood
  int num_bins = 5;           // of distance, at most 16
  double plane_radius_m = 0;  // largest radius reported
};

// [m] Minimum surface radius by the radius-based surface descriptor (paper, section 3, step iv;
// Marton et al. 2010), element by element of the PointImage; 0.9 plane_radius_m on planes, 0 where
// the normal is unknown.
//
// Two points of a sphere of radius r with normals at angle a are 2 r sin(a / 2) ~ r a apart. Of the
// neighbours, the largest angle in each distance bin belongs to the direction of the smallest
// radius; r_min is the slope of distance over that angle.
std::vector<float> EstimateMinimumRadius(const PointImage& points, const NormalImage& normals,
                                         const RsdParameters& rsd);

}  // namespace declutter
