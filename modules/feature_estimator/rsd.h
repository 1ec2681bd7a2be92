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

// What EstimateMinimumRadius gives, and what it needs meanwhile.
struct RadiusImage {
  std::vector<float> r_min;    // [m] element by element
  std::vector<float> known_x;  // x of points with a normal, kFar elsewhere
};

// Minimum surface radius by the radius-based surface descriptor (paper, section 3, step iv;
// Marton et al. 2010), element by element of the PointImage; 0.9 plane_radius_m on planes, 0 where
// the normal is unknown.
//
// Two points of a sphere of radius r with normals at angle a are 2 r sin(a / 2) ~ r a apart. Of the
// neighbours, the largest angle in each distance bin belongs to the direction of the smallest
// radius; r_min is the slope of distance over that angle.
RadiusImage EstimateMinimumRadius(const PointImage& points, const NormalImage& normals,
                                  const RsdParameters& rsd, RadiusImage recycled = {});

}  // namespace declutter
