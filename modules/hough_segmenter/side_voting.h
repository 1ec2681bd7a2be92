#pragma once

#include <vector>

#include "modules/hough_segmenter/ransac_fits.h"

namespace declutter {

// A peak of the parameter space with its recomputed inliers.
template <typename Model>
struct Detection {
  Model model;
  int component = 0;
  int num_votes = 0;
  int num_points = 0;   // [px] inliers
  float agreement = 0;  // mean agreement of the inliers with the model, in [0, 1]
};
using Face = Detection<LineModel>;
using Arc = Detection<CircleModel>;

struct SideDetections {
  std::vector<Face> faces;
  std::vector<Arc> arcs;
};

// The list of section 4: I iterations of fits on the component, votes, peak, recomputed inliers,
// removal, until nothing with N points is left. Appends to `detections`.
void DetectSides(const HoughSegmenterConfig& config, FeatureMode mode,
                 const std::vector<SideCell>& cells, int component, uint64_t seed,
                 SideDetections* detections);

}  // namespace declutter
