#include "modules/hough_segmenter/disc_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace declutter {
namespace {

constexpr size_t kMaxCorners = 18;        // edge points that circles are laid through
constexpr size_t kMaxScored = 120;        // edge points that decide between them
constexpr float kMaxEdgeError = 0.003f;   // [m] of an edge point on the circle
constexpr float kMinShare = 0.6f;         // of the edge points that must lie on the circle
constexpr float kMinShareOfPart = 0.25f;  // the same where other faces belong to the patch
constexpr float kMinArcOfPart = 2.0f;     // [rad] that must be seen then
constexpr float kMaxOutside = 0.05f;      // share of the patch that may lie outside
constexpr float kMinSagitta = 0.004f;     // [m] of the arc: what tells it from a straight edge
constexpr float kArcBin = 0.15f;          // [rad]

using Points = std::vector<Eigen::Vector2f>;

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

void TakeEveryNth(const Points& points, size_t max_num, PlanarPoints* some) {
  const size_t stride = points.size() / max_num + 1;
  some->Clear();
  for (size_t i = 0; i < points.size(); i += stride) some->Add(points[i]);
}

// Least squares on the edge points near the circle.
void FitToEdge(const Points& edge, float tolerance, CircleModel* circle) {
  for (int iteration = 0; iteration < 4; ++iteration) {
    Eigen::Matrix3f H = Eigen::Matrix3f::Identity() * 1e-6f;
    Eigen::Vector3f g = Eigen::Vector3f::Zero();
    for (const Eigen::Vector2f& p : edge) {
      const Eigen::Vector2f q = p - circle->c;
      const float distance = q.norm();
      if (std::abs(distance - circle->r) > tolerance || distance < 1e-6f) continue;
      const Eigen::Vector3f J(-q.x() / distance, -q.y() / distance, -1.0f);
      H += J * J.transpose();
      g += J * (distance - circle->r);
    }
    const Eigen::Vector3f step = H.ldlt().solve(g);
    circle->c -= step.head<2>();
    circle->r -= step.z();
  }
}

// [rad] of the circle on which there are edge points.
float ArcOf(const Points& edge, const CircleModel& circle, float tolerance) {
  std::array<char, static_cast<size_t>(2 * M_PI / kArcBin) + 1> is_covered{};
  for (const Eigen::Vector2f& p : edge) {
    const Eigen::Vector2f q = p - circle.c;
    if (std::abs(q.norm() - circle.r) > tolerance) continue;
    const float angle = std::atan2(q.y(), q.x()) + static_cast<float>(M_PI);
    is_covered[static_cast<size_t>(angle / kArcBin)] = 1;
  }
  return kArcBin * static_cast<float>(std::count(is_covered.begin(), is_covered.end(), 1));
}

bool Contains(const TopPatch& patch, const CircleModel& circle, float tolerance) {
  const size_t num = patch.points.size();
  const size_t num_inside = CountInside(patch.points.x(), patch.points.y(), num,
                                        {circle.c.x(), circle.c.y(), circle.r + tolerance});
  return static_cast<float>(num - num_inside) < kMaxOutside * static_cast<float>(num);
}

}  // namespace

DiscFitter::BestCircles DiscFitter::FindBest(float min_radius_m, float max_radius_m,
                                             float tolerance) const {
  BestCircles best;
  for (size_t i = 0; i < corners_.size(); ++i) {
    for (size_t j = i + 1; j < corners_.size(); ++j) {
      for (size_t k = j + 1; k < corners_.size(); ++k) {
        const auto circle = CircleThrough(corners_[i], corners_[j], corners_[k]);
        if (!circle || circle->r < min_radius_m || circle->r > max_radius_m) continue;
        const RingCount count =
            CountOnRing(scored_.x(), scored_.y(), scored_.size(), ShapeOf(*circle), tolerance);
        best.whole.Replace(*circle, count.num_on);
        best.part.Replace(*circle, count.num_on - 2 * count.num_inside);
      }
    }
  }
  return best;
}

std::optional<CircleModel> DiscFitter::Fit(const TopPatch& patch, float min_radius_m,
                                           float max_radius_m) {
  const float tolerance = std::max(kMaxEdgeError, 2 * patch.sigma);
  TakeEveryNth(patch.free_edge, kMaxCorners, &corners_);
  TakeEveryNth(patch.free_edge, kMaxScored, &scored_);
  const BestCircles best = FindBest(min_radius_m, max_radius_m, tolerance);
  const auto has_share = [&](const ScoredCircle& scored, float min_share) {
    return scored.score > 0 &&
           static_cast<float>(scored.score) >= min_share * static_cast<float>(scored_.size());
  };
  const auto arc = [&](const CircleModel& circle) {
    return std::min(ArcOf(patch.free_edge, circle, tolerance), static_cast<float>(M_PI));
  };
  const auto refit = [&](std::optional<CircleModel>* circle) {
    FitToEdge(patch.free_edge, 2 * tolerance, &**circle);
    if ((*circle)->r < min_radius_m || (*circle)->r > max_radius_m) circle->reset();
  };

  if (has_share(best.whole, kMinShare)) {
    std::optional<CircleModel> whole = best.whole.circle;
    refit(&whole);
    if (whole && whole->r * (1 - std::cos(0.5f * arc(*whole))) >= kMinSagitta &&
        Contains(patch, *whole, tolerance)) {
      return whole;
    }
  }
  // Faces of one height that touch are one patch: a disc may be a part of it.
  if (!has_share(best.part, kMinShareOfPart)) return std::nullopt;
  std::optional<CircleModel> part = best.part.circle;
  refit(&part);
  if (!part || arc(*part) < kMinArcOfPart) return std::nullopt;
  return part;
}

}  // namespace declutter
