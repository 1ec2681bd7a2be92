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

template <typename Model>
Detection<Model> MakeDetection(const Fit<Model>& fit, int component, int num_votes) {
  Detection<Model> detection;
  detection.model = fit.model;
  detection.component = component;
  detection.num_votes = num_votes;
  detection.num_points = static_cast<int>(fit.num_points);
  detection.agreement = fit.support / fit.num_points;
  return detection;
}

// The fits of one iteration, in the order in which they were made.
struct SideFits {
  std::vector<LineFit> lines;
  std::vector<CircleFit> circles;
};

// One iteration of section 4: fits, takes the better supported model, removes its inliers and fits
// again until too few points remain.
SideFits FitSides(SideFitter* fitter, std::vector<char> is_free);

// Finds the faces and arcs in the cells of one component and appends them to `detections`.
using SideDetector = void (*)(const HoughSegmenterConfig& config, FeatureMode mode,
                              const std::vector<SideCell>& cells, int component, uint64_t seed,
                              SideDetections* detections);

// The list of section 4: I iterations of fits on the component, votes, peak, recomputed inliers,
// removal, until nothing with N points is left. Appends to `detections`.
void DetectSides(const HoughSegmenterConfig& config, FeatureMode mode,
                 const std::vector<SideCell>& cells, int component, uint64_t seed,
                 SideDetections* detections);

}  // namespace declutter
