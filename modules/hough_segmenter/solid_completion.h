#pragma once

#include <vector>

#include "modules/geometry/solid.h"
#include "modules/hough_segmenter/disc_fit.h"
#include "modules/hough_segmenter/hough_segmenter.pb.h"
#include "modules/hough_segmenter/point_grid.h"
#include "modules/hough_segmenter/rectangle.h"
#include "modules/hough_segmenter/side_voting.h"
#include "modules/hough_segmenter/top_patches.h"

namespace declutter {

// [m] between the upper end of a side and the top of the same object.
inline constexpr float kTopTolerance = 0.025f;
// [m] of side below a top of which no side is seen.
inline constexpr float kTopOnlyDepth = 0.005f;

// [m] lower end of a solid whose side was seen down to z_min: when little is unseen above the
// support, it stands there.
inline float BottomOf(float z_min) { return z_min < 0.020f ? 0.0f : z_min; }

// Full solids from what was seen of them, with memory that is used again. Hypotheses in T: X_CO
// holds X_TO; each call appends some. Where nothing is seen below a solid, it ends there and the
// evidence of its height is kAssumed.
class SolidCompletion {
 public:
  explicit SolidCompletion(const HoughSegmenterConfig& config) : config_(config) {}

  // Measures the extents of faces and arcs again on the side points instead of the cells, where
  // normals and curvature near an outline have kept cells out.
  void MeasureExtents(const PointGrid& sides, SideDetections* detections);

  // Region growing from front faces and top faces to full boxes (paper, section 4).
  void CompleteBoxes(const std::vector<Face>& faces, const TopPatches& tops,
                     std::vector<Hypothesis>* hypotheses);

  // Full cylinders from arcs and discs, in the same way.
  void CompleteCylinders(const std::vector<Arc>& arcs, const TopPatches& tops,
                         std::vector<Hypothesis>* hypotheses);

  // For each of the hypotheses of which only the top is known (kTopOnlyDepth below it): the same
  // one with its side, down to where side points lie on it, when there are any.
  void AddSidesBelowTops(const PointGrid& sides, std::vector<Hypothesis>* hypotheses);

 private:
  void Measure(const PointGrid& sides, Face* face);
  void Measure(const PointGrid& sides, Arc* arc);
  // Rectangles of a top patch and the faces; has_depth_ tells which faces became one.
  void AddRectangles(const TopPatch& patch);

  HoughSegmenterConfig config_;
  std::vector<float> s_values_, z_values_;
  std::vector<Face> faces_;
  std::vector<char> has_depth_;  // of faces_
  TopPatches joined_tops_;
  std::vector<const Face*> attached_;
  RectangleFinder rectangle_finder_;
  std::vector<Rectangle> rectangles_;
  DiscFitter disc_fitter_;
};

}  // namespace declutter
