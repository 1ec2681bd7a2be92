#pragma once

#include "modules/hough_segmenter/side_voting.h"

namespace declutter {

// Takes the fits of a single iteration as they are, each as a detection with one vote: RANSAC
// without the parameter space, as before Hough voting (paper, section 6, 'original'). A
// SideDetector; num_iterations has no meaning here.
void FitSidesOnce(int component, SideSearch* search, SideDetections* detections);

}  // namespace declutter
