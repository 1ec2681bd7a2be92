#pragma once

#include <vector>

#include "modules/hough_segmenter/side_voting.h"

namespace declutter {

// Takes the fits of a single iteration as they are, each as a detection with one vote: RANSAC
// without the parameter space, as before Hough voting (paper, section 6, 'original'). A
// SideDetector; config.num_iterations has no meaning here.
void FitSidesOnce(const HoughSegmenterConfig& config, FeatureMode mode,
                  const std::vector<SideCell>& cells, int component, uint64_t seed,
                  SideDetections* detections);

}  // namespace declutter
