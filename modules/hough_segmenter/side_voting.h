#pragma once

#include <vector>

#include "modules/hough_segmenter/parameter_space.h"
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

  void Clear() {
    faces.clear();
    arcs.clear();
  }
  void Add(const LineFit& fit, int component, int num_votes);
  void Add(const CircleFit& fit, int component, int num_votes);
};

// What finds faces and arcs in the cells of one component after the other, with memory that is used
// again.
struct SideSearch {
  explicit SideSearch(const HoughSegmenterConfig& config)
      : num_iterations(config.num_iterations()), fitter(config) {}

  int num_iterations;
  SideFitter fitter;
  ParameterSpace<LineModel> line_votes;
  ParameterSpace<CircleModel> circle_votes;
  LineFit line;
  CircleFit circle;
};

// One iteration of section 4: fits, takes the better supported model, removes its inliers and fits
// again until too few points remain. Calls take(fit) for each in this order.
template <typename TakeFit>
void FitSides(SideSearch* search, TakeFit take) {
  SideFitter& fitter = search->fitter;
  LineFit& line = search->line;
  CircleFit& circle = search->circle;
  bool has_line = false;
  bool has_circle = false;
  fitter.Restart();
  while (true) {
    if (!has_line) has_line = fitter.FitLine(&line);
    if (!has_circle) has_circle = fitter.FitCircle(&circle);
    if (!has_line && !has_circle) return;
    // A fit that lost to the other shape stays in the race as long as its inliers do.
    const bool share_cells = has_line && has_circle && line.inliers.Intersects(circle.inliers);
    if (has_line && (!has_circle || line.support >= circle.support)) {
      fitter.Take(line.inliers);
      take(line);
      has_line = false;
      has_circle = has_circle && !share_cells;
    } else {
      fitter.Take(circle.inliers);
      take(circle);
      has_circle = false;
      has_line = has_line && !share_cells;
    }
  }
}

// Finds the faces and arcs in the cells of the component that the fitter was given and appends them
// to `detections`.
using SideDetector = void (*)(int component, SideSearch* search, SideDetections* detections);

// The list of section 4: I iterations of fits on the component, votes, peak, recomputed inliers,
// removal, until nothing with N points is left or the tests of the fitter are spent: then peaks are
// taken from the votes cast by then.
void DetectSides(int component, SideSearch* search, SideDetections* detections);

}  // namespace declutter
