#pragma once

#include <Eigen/Core>
#include <vector>

#include "modules/plane_filter/inverse_depth.h"
#include "modules/plane_filter/plane_filter.pb.h"

namespace declutter {

// Pixels of what stands on the support: connected regions that rise clearly above it, over its hull
// (widened where a region as a whole stands there), and down to their feet (paper, section 3, step
// i). hull_T as HullInPlane gives it; Pixels in or behind a wall are not objects.
PixelMask ObjectPixels(const InverseDepth& image, const InversePlane& support,
                       const std::vector<Eigen::Vector2d>& hull_T,
                       const std::vector<InversePlane>& walls, const PlaneFilterConfig& config);

}  // namespace declutter
