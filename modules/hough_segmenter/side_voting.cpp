#include "modules/hough_segmenter/side_voting.h"

#include <algorithm>

#include "modules/hough_segmenter/parameter_space.h"

namespace declutter {
namespace {

struct Votes {
  ParameterSpace<LineModel> lines;
  ParameterSpace<CircleModel> circles;
};

void Remove(const std::vector<int>& inliers, std::vector<char>* is_free) {
  for (int i : inliers) (*is_free)[static_cast<size_t>(i)] = 0;
}

bool AreFree(const std::vector<int>& inliers, const std::vector<char>& is_free) {
  return std::all_of(inliers.begin(), inliers.end(),
                     [&](int i) { return is_free[static_cast<size_t>(i)]; });
}

// Turns the highest peak of a space into a detection and removes what it explains.
template <typename Model>
void TakePeak(const SideFitter& fitter, int component,
              const typename ParameterSpace<Model>::Peak& peak, ParameterSpace<Model>* space,
              std::vector<char>* is_free, std::vector<Detection<Model>>* detections) {
  const auto fit = fitter.Refit(peak.model, *is_free);
  space->Remove(peak.strongest);
  if (!fit) return;
  Remove(fit->inliers, is_free);
  detections->push_back(MakeDetection(*fit, component, peak.num_votes));
}

}  // namespace

SideFits FitSides(SideFitter* fitter, std::vector<char> is_free) {
  SideFits fits;
  std::optional<LineFit> line;
  std::optional<CircleFit> circle;
  while (true) {
    // A fit that lost to the other shape stays in the race as long as its inliers do.
    if (!line || !AreFree(line->inliers, is_free)) line = fitter->FitLine(is_free);
    if (!circle || !AreFree(circle->inliers, is_free)) circle = fitter->FitCircle(is_free);
    if (!line && !circle) return fits;
    if (line && (!circle || line->support >= circle->support)) {
      Remove(line->inliers, &is_free);
      fits.lines.push_back(std::move(*line));
      line.reset();
    } else {
      Remove(circle->inliers, &is_free);
      fits.circles.push_back(std::move(*circle));
      circle.reset();
    }
  }
}

void DetectSides(const HoughSegmenterConfig& config, FeatureMode mode,
                 const std::vector<SideCell>& cells, int component, uint64_t seed,
                 SideDetections* detections) {
  SideFitter fitter(config, mode, cells, seed);
  std::vector<char> is_free(cells.size(), 1);
  const auto num_detections = [&] { return detections->faces.size() + detections->arcs.size(); };
  size_t num_before = 0;
  do {
    num_before = num_detections();
    Votes votes;
    for (int iteration = 0; iteration < config.num_iterations(); ++iteration) {
      SideFits fits = FitSides(&fitter, is_free);
      for (LineFit& line : fits.lines) votes.lines.Add(std::move(line));
      for (CircleFit& circle : fits.circles) votes.circles.Add(std::move(circle));
    }
    while (true) {
      const auto line = votes.lines.HighestPeak();
      const auto circle = votes.circles.HighestPeak();
      if (!line && !circle) break;
      if (line && (!circle || line->density >= circle->density)) {
        TakePeak(fitter, component, *line, &votes.lines, &is_free, &detections->faces);
      } else {
        TakePeak(fitter, component, *circle, &votes.circles, &is_free, &detections->arcs);
      }
      votes.lines.KeepSupported(cells, is_free);
      votes.circles.KeepSupported(cells, is_free);
    }
  } while (num_detections() > num_before);
}

}  // namespace declutter
