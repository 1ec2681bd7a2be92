#include "modules/hough_segmenter/disc_fit.h"

#include <Eigen/Dense>
#include <algorithm>
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

Points EveryNth(const Points& points, size_t max_num) {
  const size_t stride = points.size() / max_num + 1;
  Points some;
  for (size_t i = 0; i < points.size(); i += stride) some.push_back(points[i]);
  return some;
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
  std::vector<char> is_covered(static_cast<size_t>(2 * M_PI / kArcBin) + 1, 0);
  for (const Eigen::Vector2f& p : edge) {
    const Eigen::Vector2f q = p - circle.c;
    if (std::abs(q.norm() - circle.r) > tolerance) continue;
    const float angle = std::atan2(q.y(), q.x()) + static_cast<float>(M_PI);
    is_covered[static_cast<size_t>(angle / kArcBin)] = 1;
  }
  return kArcBin * static_cast<float>(std::count(is_covered.begin(), is_covered.end(), 1));
}

bool Contains(const TopPatch& patch, const CircleModel& circle, float tolerance) {
  int num_outside = 0;
  for (const Eigen::Vector2f& p : patch.points) {
    num_outside += (p - circle.c).norm() > circle.r + tolerance;
  }
  return static_cast<float>(num_outside) < kMaxOutside * static_cast<float>(patch.points.size());
}

struct ScoredCircle {
  CircleModel circle;
  int score = 0;  // edge points

  // The first of the best ones.
  void Replace(const CircleModel& other, int other_score) {
    if (other_score > score) *this = {other, other_score};
  }
};

// The best circles through three of the corners. On an edge that is all of a disc most points are
// on the circle; on one that has other parts too none are far inside. Scores 0: none.
struct BestCircles {
  ScoredCircle whole;
  ScoredCircle part;
};

BestCircles FindBest(const Points& edge, float min_radius_m, float max_radius_m, float tolerance,
                     size_t* num_scored) {
  const Points corners = EveryNth(edge, kMaxCorners);
  const Points scored = EveryNth(edge, kMaxScored);
  *num_scored = scored.size();
  std::vector<float> x(scored.size() + kCellBlock), y(x.size());
  for (size_t i = 0; i < scored.size(); ++i) {
    x[i] = scored[i].x();
    y[i] = scored[i].y();
  }
  BestCircles best;
  for (size_t i = 0; i < corners.size(); ++i) {
    for (size_t j = i + 1; j < corners.size(); ++j) {
      for (size_t k = j + 1; k < corners.size(); ++k) {
        const auto circle = CircleThrough(corners[i], corners[j], corners[k]);
        if (!circle || circle->r < min_radius_m || circle->r > max_radius_m) continue;
        const RingCount count =
            CountOnRing(x.data(), y.data(), scored.size(), ShapeOf(*circle), tolerance);
        best.whole.Replace(*circle, count.num_on);
        best.part.Replace(*circle, count.num_on - 2 * count.num_inside);
      }
    }
  }
  return best;
}

}  // namespace

std::optional<CircleModel> FitDisc(const TopPatch& patch, float min_radius_m, float max_radius_m) {
  const float tolerance = std::max(kMaxEdgeError, 2 * patch.sigma);
  size_t num_scored = 0;
  const BestCircles best =
      FindBest(patch.free_edge, min_radius_m, max_radius_m, tolerance, &num_scored);
  const auto has_share = [&](const ScoredCircle& scored, float min_share) {
    return scored.score > 0 &&
           static_cast<float>(scored.score) >= min_share * static_cast<float>(num_scored);
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
