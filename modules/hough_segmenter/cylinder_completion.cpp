#include <Eigen/Dense>
#include <cmath>
#include <optional>

#include "modules/hough_segmenter/solid_completion.h"

namespace declutter {
namespace {

constexpr float kTopTolerance = 0.025f;     // [m] between the top of an arc and the disc above it
constexpr float kMaxBottomGap = 0.020f;     // [m] unseen above the support: it stands there
constexpr float kMaxOutlineError = 0.004f;  // [m] rms of a disc's outline
constexpr float kMinDiscFill = 0.5f;        // of the circle's area that the patch's hull covers

Hypothesis MakeCylinder(const CircleModel& circle, int component) {
  Hypothesis hypothesis;
  const float bottom = circle.z_min < kMaxBottomGap ? 0.0f : circle.z_min;
  hypothesis.solid.shape = Shape::kCylinder;
  hypothesis.solid.X_CO.translation() =
      Eigen::Vector3f(circle.c.x(), circle.c.y(), 0.5f * (bottom + circle.z_max)).cast<double>();
  hypothesis.solid.size = Eigen::Vector3d(2 * circle.r, 2 * circle.r, circle.z_max - bottom);
  hypothesis.evidence[2] = bottom > 0 ? Evidence::kAssumed : Evidence::kObserved;
  hypothesis.component = component;
  return hypothesis;
}

// The disc on top of an arc: most of the patch lies inside the circle, at about its upper end.
const TopPatch* DiscOf(const CircleModel& circle, const std::vector<TopPatch>& tops) {
  const TopPatch* best = nullptr;
  for (const TopPatch& patch : tops) {
    if (std::abs(patch.height - circle.z_max) > kTopTolerance) continue;
    size_t num_inside = 0;
    for (const Eigen::Vector2f& p : patch.points) {
      num_inside += (p - circle.c).norm() < circle.r + 0.006f;
    }
    if (static_cast<double>(num_inside) < 0.8 * static_cast<double>(patch.points.size())) continue;
    if (best == nullptr || patch.points.size() > best->points.size()) best = &patch;
  }
  return best;
}

// Algebraic circle through the outline of a patch; nothing when the outline is not round.
std::optional<CircleModel> FitDisc(const TopPatch& patch) {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  const Eigen::Vector2f origin = patch.hull[0];
  double area = 0;
  for (size_t i = 0; i < patch.hull.size(); ++i) {
    const Eigen::Vector2d p = (patch.hull[i] - origin).cast<double>();
    const Eigen::Vector2d q = (patch.hull[(i + 1) % patch.hull.size()] - origin).cast<double>();
    area += 0.5 * (p.x() * q.y() - p.y() * q.x());
    // Points along the edge, so that its length counts.
    const int num_steps = 1 + static_cast<int>((q - p).norm() / 0.002);
    for (int step = 0; step < num_steps; ++step) {
      const Eigen::Vector2d r = p + (q - p) * step / num_steps;
      const Eigen::Vector3d row(r.x(), r.y(), 1);
      A += row * row.transpose();
      b += row * r.squaredNorm();
    }
  }
  const Eigen::Vector3d x = A.ldlt().solve(b);
  CircleModel circle;
  const Eigen::Vector2d c = 0.5 * x.head<2>();
  const double r = std::sqrt(std::max(0.0, x.z() + c.squaredNorm()));
  double squared_error = 0;
  for (const Eigen::Vector2f& p : patch.hull) {
    squared_error += std::pow(((p - origin).cast<double>() - c).norm() - r, 2);
  }
  const double rms = std::sqrt(squared_error / static_cast<double>(patch.hull.size()));
  if (!(rms < kMaxOutlineError) || area < kMinDiscFill * M_PI * r * r) return std::nullopt;
  circle.c = c.cast<float>() + origin;
  circle.r = static_cast<float>(r);
  circle.z_min = patch.height - 0.005f;
  circle.z_max = patch.height;
  return circle;
}

}  // namespace

std::vector<Hypothesis> CompleteCylinders(const HoughSegmenterConfig& config,
                                          const Surfaces& surfaces) {
  std::vector<Hypothesis> hypotheses;
  for (const Arc& arc : surfaces.arcs) {
    CircleModel circle = arc.model;
    const TopPatch* disc = DiscOf(circle, surfaces.tops);
    if (disc != nullptr) circle.z_max = disc->height;
    Hypothesis hypothesis = MakeCylinder(circle, arc.component);
    hypothesis.num_votes = arc.num_votes;
    hypothesis.num_inliers =
        arc.num_points + (disc != nullptr ? static_cast<int>(disc->points.size()) : 0);
    hypothesis.score = arc.agreement;
    hypotheses.push_back(hypothesis);
  }
  for (const TopPatch& patch : surfaces.tops) {
    const auto circle = FitDisc(patch);
    if (!circle || circle->r < config.min_radius_m() || circle->r > config.max_radius_m()) continue;
    Hypothesis hypothesis = MakeCylinder(*circle, patch.component);
    hypothesis.num_inliers = static_cast<int>(patch.points.size());
    hypothesis.score = 0.5f;
    hypotheses.push_back(hypothesis);
  }
  return hypotheses;
}

}  // namespace declutter
