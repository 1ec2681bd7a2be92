#include "modules/hough_segmenter/side_voting.h"

namespace declutter {
namespace {

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

// Turns the highest peak of a space into a detection and closes the cells that it explains.
template <typename Model>
void TakePeak(int component, const typename ParameterSpace<Model>::Peak& peak, SideSearch* search,
              ParameterSpace<Model>* space, Fit<Model>* fit, SideDetections* detections) {
  space->Remove(peak);
  if (!search->fitter.Refit(peak.model, fit)) return;
  detections->Add(*fit, component, peak.num_votes);
  search->fitter.Explain(fit->inliers);
  search->line_votes.Explain(search->fitter.cells(), fit->inliers);
  search->circle_votes.Explain(search->fitter.cells(), fit->inliers);
}

}  // namespace

void SideDetections::Add(const LineFit& fit, int component, int num_votes) {
  faces.push_back(MakeDetection(fit, component, num_votes));
}

void SideDetections::Add(const CircleFit& fit, int component, int num_votes) {
  arcs.push_back(MakeDetection(fit, component, num_votes));
}

void DetectSides(int component, SideSearch* search, SideDetections* detections) {
  struct Caster {
    void operator()(const LineFit& fit) { search->line_votes.Add(fit); }
    void operator()(const CircleFit& fit) { search->circle_votes.Add(fit); }
    SideSearch* search;
  };
  const auto num_detections = [&] { return detections->faces.size() + detections->arcs.size(); };
  size_t num_before = 0;
  do {
    num_before = num_detections();
    search->line_votes.Clear();
    search->circle_votes.Clear();
    for (int i = 0; i < search->num_iterations && !search->fitter.is_spent(); ++i) {
      FitSides(search, Caster{search});
    }
    search->line_votes.Connect();
    search->circle_votes.Connect();
    while (true) {
      const auto line = search->line_votes.HighestPeak();
      const auto circle = search->circle_votes.HighestPeak();
      if (!line && !circle) break;
      if (line && (!circle || line->density >= circle->density)) {
        TakePeak(component, *line, search, &search->line_votes, &search->line, detections);
      } else {
        TakePeak(component, *circle, search, &search->circle_votes, &search->circle, detections);
      }
    }
  } while (num_detections() > num_before);
}

}  // namespace declutter
