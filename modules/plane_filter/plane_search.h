#pragma once

#include <vector>

#include "modules/plane_filter/inverse_depth.h"
#include "modules/plane_filter/plane_filter.pb.h"

namespace declutter {

// A dominant plane and the connected regions of the image that lie in it.
struct PlaneCandidate {
  InversePlane plane;
  PixelMask region;    // as CoherentRegion gives it
  int num_pixels = 0;  // of the region
};

// Pixels within band [1/m] of the plane whose neighbours mostly are too, in connected regions of at
// least min_region_pixels that lie in the plane instead of cutting through it.
PixelMask CoherentRegion(const InverseDepth& image, const InversePlane& plane, float band,
                         int min_region_pixels);

// Dominant planes by RANSAC, refined by least squares, largest first as they are found and removed
// (paper, section 3, step i).
std::vector<PlaneCandidate> FindPlanes(const InverseDepth& grid, const PlaneFilterConfig& config);

}  // namespace declutter
