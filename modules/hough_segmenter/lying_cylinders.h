#pragma once

#include <vector>

#include "modules/geometry/solid.h"
#include "modules/hough_segmenter/hough_segmenter.pb.h"
#include "modules/hough_segmenter/top_patches.h"

namespace declutter {

// Cylinders that lie on their side: the votes for circles of section 4, cast in vertical planes
// across the highest line of each curved surface. Hypotheses in T (X_CO holds X_TO); z of O is the
// horizontal axis. Needs no horizontal curvature.
std::vector<Hypothesis> FindLyingCylinders(const HoughSegmenterConfig& config,
                                           const std::vector<TablePoint>& points,
                                           const std::vector<TopPatch>& tops, uint64_t seed);

}  // namespace declutter
