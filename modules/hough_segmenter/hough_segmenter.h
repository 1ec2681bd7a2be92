#pragma once

#include "modules/geometry/feature_cloud.h"
#include "modules/geometry/solid.h"
#include "modules/geometry/tabletop.h"
#include "modules/hough_segmenter/hough_segmenter.pb.h"

namespace declutter {

// Proposes boxes and cylinders by votes of randomised line and circle fits (paper, sections 4 and
// 5).
class HoughSegmenter {
 public:
  explicit HoughSegmenter(const HoughSegmenterConfig& config);

  // Hypotheses in C, best first. Tabletop and features must be of the same frame.
  HypothesisList Segment(const Tabletop& tabletop, const FeatureCloud& features) const;

 private:
  HoughSegmenterConfig config_;
};

}  // namespace declutter
