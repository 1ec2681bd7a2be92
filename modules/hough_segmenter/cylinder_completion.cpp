#include <Eigen/Dense>
#include <cmath>
#include <optional>

#include "modules/hough_segmenter/solid_completion.h"

namespace declutter {
namespace {

constexpr float kOutlineStep = 0.002f;      // [m] between points of an outline
constexpr float kMaxOutlineError = 0.003f;  // [m] of a disc's outline
constexpr size_t kMaxCorners = 20;          // outline points that circles are laid through
constexpr float kMinDiscArc = 2.0f;         // [rad] of the circle that the outline covers
constexpr double kMinDiscShare = 0.5;       // of the outline that lies on the circle

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

// Points along the hull, so that the length of its edges counts.
std::vector<Eigen::Vector2f> Outline(const std::vector<Eigen::Vector2f>& hull) {
  std::vector<Eigen::Vector2f> points;
  for (size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector2f edge = hull[(i + 1) % hull.size()] - hull[i];
    const int num_steps = 1 + static_cast<int>(edge.norm() / kOutlineStep);
    for (int step = 0; step < num_steps; ++step) {
      points.emplace_back(hull[i] +
                          edge * (static_cast<float>(step) / static_cast<float>(num_steps)));
    }
  }
  return points;
}

std::optional<CircleModel> CircleThrough(const Eigen::Vector2f& a, const Eigen::Vector2f& b,
                                         const Eigen::Vector2f& c) {
  Eigen::Matrix2f A;
  A << (b - a).transpose(), (c - a).transpose();
  if (std::abs(A.determinant()) < 1e-5f) return std::nullopt;
  const Eigen::Vector2f rhs(0.5f * (b.squaredNorm() - a.squaredNorm()),
                            0.5f * (c.squaredNorm() - a.squaredNorm()));
  CircleModel circle;
  circle.c = A.inverse() * rhs;
  circle.r = (circle.c - a).norm();
  return circle;
}

// Outline points on the circle; none when part of the patch lies outside it.
int NumOnCircle(const std::vector<Eigen::Vector2f>& outline, const CircleModel& circle) {
  int num = 0;
  for (const Eigen::Vector2f& p : outline) {
    const float distance = (p - circle.c).norm() - circle.r;
    if (distance > kMaxOutlineError) return 0;
    num += distance > -kMaxOutlineError;
  }
  return num;
}

// The circle that the largest part of a patch's outline lies on, the rest being cut off by what
// hides it; nothing when that part is small.
std::optional<CircleModel> FitDisc(const HoughSegmenterConfig& config, const TopPatch& patch) {
  const std::vector<Eigen::Vector2f> outline = Outline(patch.hull);
  const size_t stride = outline.size() / kMaxCorners + 1;
  CircleModel best;
  int best_num = 0;
  for (size_t i = 0; i < outline.size(); i += stride) {
    for (size_t j = i + stride; j < outline.size(); j += stride) {
      for (size_t k = j + stride; k < outline.size(); k += stride) {
        const auto circle = CircleThrough(outline[i], outline[j], outline[k]);
        if (!circle || circle->r < config.min_radius_m() || circle->r > config.max_radius_m()) {
          continue;
        }
        const int num = NumOnCircle(outline, *circle);
        if (num <= best_num) continue;
        best_num = num;
        best = *circle;
      }
    }
  }
  const float arc = static_cast<float>(best_num) * kOutlineStep;
  if (arc < kMinDiscArc * best.r ||
      static_cast<double>(best_num) < kMinDiscShare * static_cast<double>(outline.size())) {
    return std::nullopt;
  }
  best.z_min = patch.height - kTopOnlyDepth;
  best.z_max = patch.height;
  return best;
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
    const auto circle = FitDisc(config, patch);
    if (!circle) continue;
    Hypothesis hypothesis = MakeCylinder(*circle, patch.component);
    hypothesis.num_inliers = static_cast<int>(patch.points.size());
    hypothesis.score = 0.5f;
    hypotheses.push_back(hypothesis);
  }
  return hypotheses;
}

}  // namespace declutter
