#include <cmath>

#include "modules/hough_segmenter/disc_fit.h"
#include "modules/hough_segmenter/solid_completion.h"

namespace declutter {
namespace {

Hypothesis MakeCylinder(const CircleModel& circle, int component) {
  Hypothesis hypothesis;
  const float bottom = BottomOf(circle.z_min);
  hypothesis.solid.shape = Shape::kCylinder;
  hypothesis.solid.X_CO.translation() =
      Eigen::Vector3f(circle.c.x(), circle.c.y(), 0.5f * (bottom + circle.z_max)).cast<double>();
  hypothesis.solid.size = Eigen::Vector3d(2 * circle.r, 2 * circle.r, circle.z_max - bottom);
  hypothesis.evidence[2] = bottom > 0 ? Evidence::kAssumed : Evidence::kObserved;
  hypothesis.component = component;
  return hypothesis;
}

// The disc on top of an arc: most of the patch lies inside the circle, at about its upper end.
const TopPatch* DiscOf(const CircleModel& circle, const TopPatches& tops) {
  const TopPatch* best = nullptr;
  for (const TopPatch& patch : tops) {
    if (std::abs(patch.height - circle.z_max) > kTopTolerance || patch.height <= circle.z_min) {
      continue;
    }
    const size_t num_inside = CountInside(patch.points.x(), patch.points.y(), patch.points.size(),
                                          {circle.c.x(), circle.c.y(), circle.r + 0.006f});
    if (static_cast<double>(num_inside) < 0.8 * static_cast<double>(patch.points.size())) continue;
    if (best == nullptr || patch.points.size() > best->points.size()) best = &patch;
  }
  return best;
}

}  // namespace

void SolidCompletion::CompleteCylinders(const std::vector<Arc>& arcs, const TopPatches& tops,
                                        std::vector<Hypothesis>* hypotheses) {
  for (const Arc& arc : arcs) {
    CircleModel circle = arc.model;
    const TopPatch* disc = DiscOf(circle, tops);
    if (disc != nullptr) circle.z_max = disc->height;
    Hypothesis hypothesis = MakeCylinder(circle, arc.component);
    hypothesis.num_votes = arc.num_votes;
    hypothesis.num_inliers =
        arc.num_points + (disc != nullptr ? static_cast<int>(disc->points.size()) : 0);
    hypothesis.score = arc.agreement;
    hypotheses->push_back(hypothesis);
  }
  for (const TopPatch& patch : tops) {
    auto circle = disc_fitter_.Fit(patch, static_cast<float>(config_.min_radius_m()),
                                   static_cast<float>(config_.max_radius_m()));
    if (!circle) continue;
    circle->z_min = patch.height - kTopOnlyDepth;
    circle->z_max = patch.height;
    Hypothesis hypothesis = MakeCylinder(*circle, patch.component);
    hypothesis.num_inliers = static_cast<int>(patch.points.size());
    hypothesis.score = 0.5f;
    hypotheses->push_back(hypothesis);
  }
}

}  // namespace declutter
