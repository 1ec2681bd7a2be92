#pragma once

#include <string>
#include <vector>

#include "modules/geometry/feature_cloud.h"
#include "modules/geometry/solid.h"
#include "modules/geometry/tabletop.h"
#include "modules/hough_segmenter/hough_segmenter.pb.h"
#include "modules/hough_segmenter/lying_cylinders.h"
#include "modules/hough_segmenter/point_grid.h"
#include "modules/hough_segmenter/side_voting.h"
#include "modules/hough_segmenter/solid_completion.h"
#include "modules/hough_segmenter/top_patches.h"

namespace declutter {

// Proposes boxes and cylinders by votes of randomised line and circle fits (paper, sections 4 and
// 5).
class HoughSegmenter {
 public:
  // Everything but `detect`, how faces and arcs are found in a component, is the same for every
  // segmenter that works on its sides.
  explicit HoughSegmenter(const HoughSegmenterConfig& config, SideDetector detect = DetectSides);

  // Hypotheses in C, best first. Tabletop and features must be of the same frame.
  HypothesisList Segment(const Tabletop& tabletop, const FeatureCloud& features);

  // What was left out of the last list because the work of a frame is bounded; empty: nothing.
  const std::string& shortfall() const { return shortfall_; }

 private:
  // Sets detections_ to the faces and arcs among points_, each of which stands for num_pixels.
  void FindSides(const FeatureCloud& features, int num_pixels);
  // At most max_hypotheses of proposals_, sorted by their points, without those alike.
  std::vector<Hypothesis> BestProposals();

  HoughSegmenterConfig config_;
  SideDetector detect_;
  std::string shortfall_;
  // Memory that is used again.
  std::vector<TablePoint> points_;
  SideCells cells_;
  SideSearch side_search_;
  SideDetections detections_;
  TopPatchFinder tops_;
  PointGrid sides_;
  PointGrid slants_;
  SolidCompletion completion_;
  LyingCylinders lying_;
  std::vector<Hypothesis> proposals_;  // in T
  std::vector<size_t> ranking_;        // of proposals_
};

}  // namespace declutter
