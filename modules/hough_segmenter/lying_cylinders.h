#pragma once

#include <vector>

#include "modules/geometry/solid.h"
#include "modules/hough_segmenter/hough_segmenter.pb.h"
#include "modules/hough_segmenter/point_grid.h"
#include "modules/hough_segmenter/side_voting.h"
#include "modules/hough_segmenter/top_patches.h"

namespace declutter {

// The parameters of votes in vertical planes.
HoughSegmenterConfig SectionConfig(const HoughSegmenterConfig& config);

// Cylinders that lie on their side: the votes for circles of section 4, cast in vertical planes
// across the highest line of each curved surface. Hypotheses in T (X_CO holds X_TO); z of O is the
// horizontal axis. Needs no horizontal curvature. slants holds the slanted points; search is one
// with SectionConfig(config).
std::vector<Hypothesis> FindLyingCylinders(const HoughSegmenterConfig& config,
                                           const std::vector<TablePoint>& points,
                                           const PointGrid& slants, const TopPatches& tops,
                                           SideCells* side_cells, SideSearch* search);

}  // namespace declutter
