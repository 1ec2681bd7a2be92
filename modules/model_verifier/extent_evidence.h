#pragma once

#include <array>

#include "modules/geometry/depth_image.h"
#include "modules/geometry/solid.h"

namespace declutter {

// What the horizontal extents of a box rest on (along x and y of O), from what is measured just
// beyond both of its ends: kObserved where each end is seen, either as a face or as an edge with
// free space behind; kAssumed where something in front, or a surface that goes on, hides an end.
// A cylinder's are kObserved. The evidence of the height stays as it is given, and what the
// hypothesis assumed stays assumed.
std::array<Evidence, 3> ExtentEvidence(const Solid& solid, const std::array<Evidence, 3>& given,
                                       const DepthImage& image);

}  // namespace declutter
