#include "modules/geometry/convex_hull.h"

#include <algorithm>
#include <utility>

namespace declutter {
namespace {

using Eigen::Vector2d;

double Cross(const Vector2d& o, const Vector2d& a, const Vector2d& b) {
  return (a.x() - o.x()) * (b.y() - o.y()) - (a.y() - o.y()) * (b.x() - o.x());
}

// Appends point to the chain, which turns left only; keep first_size points of it.
void AppendLeftTurn(const Vector2d& point, size_t first_size, std::vector<Vector2d>* chain) {
  while (chain->size() > first_size &&
         Cross((*chain)[chain->size() - 2], chain->back(), point) <= 0) {
    chain->pop_back();
  }
  chain->push_back(point);
}

}  // namespace

// Monotone chain (A. M. Andrew, 1979).
void ConvexHull(std::vector<Vector2d>* points, std::vector<Vector2d>* hull) {
  std::sort(points->begin(), points->end(), [](const Vector2d& a, const Vector2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  points->erase(std::unique(points->begin(), points->end()), points->end());
  hull->clear();
  if (points->size() < 3) return;
  for (const Vector2d& point : *points) AppendLeftTurn(point, 1, hull);
  const size_t lower_size = hull->size();
  for (auto point = points->rbegin() + 1; point != points->rend(); ++point) {
    AppendLeftTurn(*point, lower_size, hull);
  }
  hull->pop_back();
  if (hull->size() < 3) hull->clear();
}

std::vector<Vector2d> ConvexHull(std::vector<Vector2d> points) {
  std::vector<Vector2d> hull;
  ConvexHull(&points, &hull);
  return hull;
}

std::vector<Vector2d> SimplifyHull(std::vector<Vector2d> hull, double tolerance) {
  while (hull.size() > 3) {
    size_t flattest = 0;
    double smallest_offset = tolerance;
    for (size_t i = 0; i < hull.size(); ++i) {
      const Vector2d& before = hull[(i + hull.size() - 1) % hull.size()];
      const Vector2d& after = hull[(i + 1) % hull.size()];
      const double offset = Cross(before, hull[i], after) / (after - before).norm();
      if (offset < smallest_offset) {
        smallest_offset = offset;
        flattest = i;
      }
    }
    if (smallest_offset >= tolerance) break;
    hull.erase(hull.begin() + static_cast<std::ptrdiff_t>(flattest));
  }
  return hull;
}

ConvexRegion::ConvexRegion(const std::vector<Vector2d>& hull, double margin_m,
                           ConvexRegion recycled)
    : edges_(std::move(recycled.edges_)) {
  edges_.clear();
  for (size_t i = 0; i < hull.size(); ++i) {
    const Vector2d along = (hull[(i + 1) % hull.size()] - hull[i]).normalized();
    const Vector2d inward(-along.y(), along.x());
    edges_.push_back(
        Eigen::Vector3d(inward.x(), inward.y(), margin_m - inward.dot(hull[i])).cast<float>());
  }
}

}  // namespace declutter
