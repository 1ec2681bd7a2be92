#include "modules/scene_renderer/footprint.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace declutter {
namespace {

using Eigen::Vector2d;

std::array<Vector2d, 4> Corners(const Footprint& rectangle) {
  const Eigen::Rotation2Dd R(rectangle.yaw_rad);
  const double x = rectangle.half.x(), y = rectangle.half.y();
  return {rectangle.centre + R * Vector2d(x, y), rectangle.centre + R * Vector2d(-x, y),
          rectangle.centre + R * Vector2d(-x, -y), rectangle.centre + R * Vector2d(x, -y)};
}

// Distance of a point from a rectangle; negative inside.
double PointGap(const Footprint& rectangle, const Vector2d& point) {
  const Vector2d local = Eigen::Rotation2Dd(-rectangle.yaw_rad) * (point - rectangle.centre);
  const Vector2d excess = local.cwiseAbs() - rectangle.half;
  if (excess.maxCoeff() <= 0) return excess.maxCoeff();
  return excess.cwiseMax(0.0).norm();
}

// Largest separation of the corners of `b` from the sides of `a`.
double SideSeparation(const Footprint& a, const std::array<Vector2d, 4>& b) {
  double separation = -1e9;
  for (int axis = 0; axis < 2; ++axis) {
    const Vector2d direction = Eigen::Rotation2Dd(a.yaw_rad) * Vector2d::Unit(axis);
    double low = 1e9, high = -1e9;
    for (const Vector2d& corner : b) {
      const double along = direction.dot(corner - a.centre);
      low = std::min(low, along);
      high = std::max(high, along);
    }
    separation = std::max({separation, low - a.half[axis], -a.half[axis] - high});
  }
  return separation;
}

double RectangleGap(const Footprint& a, const Footprint& b) {
  const auto corners_a = Corners(a);
  const auto corners_b = Corners(b);
  const double separation = std::max(SideSeparation(a, corners_b), SideSeparation(b, corners_a));
  if (separation <= 0) return separation;
  // Disjoint convex polygons are nearest at a corner of one of them.
  double gap = 1e9;
  for (const Vector2d& corner : corners_b) gap = std::min(gap, PointGap(a, corner));
  for (const Vector2d& corner : corners_a) gap = std::min(gap, PointGap(b, corner));
  return gap;
}

}  // namespace

double Gap(const Footprint& a, const Footprint& b) {
  if (a.round && b.round) return (a.centre - b.centre).norm() - a.half.x() - b.half.x();
  if (a.round) return PointGap(b, a.centre) - a.half.x();
  if (b.round) return PointGap(a, b.centre) - b.half.x();
  return RectangleGap(a, b);
}

bool Contains(const Footprint& outer, const Footprint& inner, double margin_m) {
  const auto depth = [&outer](const Vector2d& point) {
    return outer.round ? outer.half.x() - (point - outer.centre).norm() : -PointGap(outer, point);
  };
  if (inner.round) return depth(inner.centre) >= inner.half.x() + margin_m;
  const auto corners = Corners(inner);
  return std::all_of(corners.begin(), corners.end(),
                     [&](const Vector2d& corner) { return depth(corner) >= margin_m; });
}

Vector2d HalfBounds(const Footprint& footprint) {
  if (footprint.round) return footprint.half;
  const double c = std::abs(std::cos(footprint.yaw_rad));
  const double s = std::abs(std::sin(footprint.yaw_rad));
  return {c * footprint.half.x() + s * footprint.half.y(),
          s * footprint.half.x() + c * footprint.half.y()};
}

}  // namespace declutter
