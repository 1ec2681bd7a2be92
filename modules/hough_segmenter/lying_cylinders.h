#pragma once

#include <cstdint>
#include <vector>

#include "modules/geometry/solid.h"
#include "modules/hough_segmenter/hough_segmenter.pb.h"
#include "modules/hough_segmenter/point_grid.h"
#include "modules/hough_segmenter/side_voting.h"
#include "modules/hough_segmenter/top_patches.h"

namespace declutter {

// Finds cylinders that lie on their side: the votes for circles of section 4, cast in vertical
// planes across the highest line of each curved surface. Needs no horizontal curvature. Memory is
// used again.
class LyingCylinders {
 public:
  explicit LyingCylinders(const HoughSegmenterConfig& config);

  // Appends hypotheses in T (X_CO holds X_TO); z of O is the horizontal axis. slants holds the
  // slanted points.
  void Find(const std::vector<TablePoint>& points, const PointGrid& slants, const TopPatches& tops,
            SideCells* side_cells, std::vector<Hypothesis>* hypotheses);

 private:
  class Section;

  void SortByComponent(const std::vector<TablePoint>& points);
  // Sets points_L_ to the points of a section in L. False unless they can be those of a cylinder.
  bool FindRoundPoints(const std::vector<TablePoint>& points, const PointGrid& slants,
                       const TopPatch& patch, const Section& section);
  // Sets the ends along the axis to those of the points on the circle, where the cells only give
  // their centres.
  void MeasureEnds(CircleModel* circle);

  HoughSegmenterConfig config_;
  SideSearch search_;
  SideDetections detections_;
  std::vector<int> component_;          // of each point
  std::vector<uint32_t> first_;         // of each component in by_component_
  std::vector<uint32_t> by_component_;  // points, in their order
  std::vector<TablePoint> points_L_;
  std::vector<float> along_;
};

}  // namespace declutter
