#pragma once

#include <vector>

#include "modules/geometry/solid.h"
#include "modules/hough_segmenter/hough_segmenter.pb.h"
#include "modules/hough_segmenter/point_grid.h"
#include "modules/hough_segmenter/side_voting.h"
#include "modules/hough_segmenter/top_patches.h"

namespace declutter {

// What was seen of a component's objects. All in T.
struct Surfaces {
  std::vector<Face> faces;
  std::vector<Arc> arcs;
  std::vector<TopPatch> tops;
};

// [m] between the upper end of a side and the top of the same object.
inline constexpr float kTopTolerance = 0.025f;
// [m] of side below a top of which no side is seen.
inline constexpr float kTopOnlyDepth = 0.005f;

// [m] lower end of a solid whose side was seen down to z_min: when little is unseen above the
// support, it stands there.
inline float BottomOf(float z_min) { return z_min < 0.020f ? 0.0f : z_min; }

// Measures the extents of faces and arcs again on the side points instead of the cells, where
// normals and curvature near an outline have kept cells out.
void MeasureExtents(const PointGrid& sides, Surfaces* surfaces);

// For each of the hypotheses of which only the top is known (kTopOnlyDepth below it): the same one
// with its side, down to where side points lie on it, when there are any. Appends them. Hypotheses
// in T.
void AddSidesBelowTops(const PointGrid& sides, std::vector<Hypothesis>* hypotheses);

// Region growing from front faces and top faces to full boxes (paper, section 4). Hypotheses in T:
// X_CO holds X_TO. Where nothing is seen below a solid, it ends there and the evidence of its
// height is kAssumed.
std::vector<Hypothesis> CompleteBoxes(const HoughSegmenterConfig& config, const Surfaces& surfaces);

// Full cylinders from arcs and discs, in the same way.
std::vector<Hypothesis> CompleteCylinders(const HoughSegmenterConfig& config,
                                          const Surfaces& surfaces);

}  // namespace declutter
