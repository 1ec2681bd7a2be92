#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "modules/geometry/tabletop.h"
#include "modules/hough_segmenter/top_patches.h"

namespace declutter {

// Sets the free edges of patches, whose heights are known: the points half way between a pixel of
// the patch and one beside it, where what is seen beyond lies below the patch. What rises above it
// hides the rest of the face, or stands behind it. labels holds the patch of each pixel of the
// thinned image, row-major, -1: none; pixels are those that may have one, in order.
void AddFreeEdges(const Tabletop& tabletop, const Eigen::Isometry3d& X_TC,
                  const std::vector<int32_t>& labels, const std::vector<size_t>& pixels,
                  TopPatches* patches);

}  // namespace declutter
