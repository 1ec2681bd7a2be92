#pragma once

#include <vector>

#include "modules/plane_filter/inverse_depth.h"
#include "modules/plane_filter/plane_filter.pb.h"

namespace declutter {

// A dominant plane and the connected regions of the image that lie in it.
struct PlaneCandidate {
  InversePlane plane;
  PixelMask region;    // inliers amid inliers
  int num_pixels = 0;  // of the region
};

// Keeps inliers whose neighbours are mostly inliers, in connected regions of at least
// min_region_pixels: drops the stripes where the plane cuts through other surfaces.
PixelMask CoherentRegion(const InverseDepth& image, const PixelMask& inliers,
                         int min_region_pixels);

// Dominant planes by RANSAC, refined by least squares, largest first as they are found and removed
// (paper, section 3, step i).
std::vector<PlaneCandidate> FindPlanes(const InverseDepth& grid, const PlaneFilterConfig& config);

}  // namespace declutter
