#include "modules/model_verifier/hidden_middle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "modules/model_verifier/extents.h"

namespace declutter {
namespace {

// From the lowest to the highest coordinate along an axis.
struct Range {
  double low = std::numeric_limits<double>::max();
  double high = -low;
};

// Of the points in the prolongation of a solid along an axis; nothing when too few are.
std::optional<Range> RangeAlong(int axis, const std::vector<Eigen::Vector3d>& points_O,
                                const Eigen::Vector3d& half) {
  constexpr double kMinShare = 0.9;  // of the points
  Range range;
  size_t num = 0;
  for (const Eigen::Vector3d& p : points_O) {
    Eigen::Vector3d outside = p.cwiseAbs() - half;
    outside[axis] = 0;
    if (outside.maxCoeff() > kEdgeBlur) continue;
    range.low = std::min(range.low, p[axis]);
    range.high = std::max(range.high, p[axis]);
    ++num;
  }
  if (num == 0 || static_cast<double>(num) < kMinShare * static_cast<double>(points_O.size())) {
    return std::nullopt;
  }
  return range;
}

}  // namespace

std::optional<Solid> ProlongedOver(const std::vector<Eigen::Vector3d>& points_O, const Solid& box) {
  const Eigen::Vector3d half = 0.5 * box.size;
  for (int axis = 0; axis < 2; ++axis) {
    const auto range = RangeAlong(axis, points_O, half);
    if (!range) continue;
    const double above = range->high - half[axis];
    const double below = -half[axis] - range->low;
    if ((above > kEdgeBlur) == (below > kEdgeBlur)) continue;
    const double growth = std::max(above, below);
    if (box.size[axis] + growth > kMaxExtent) continue;
    return Longer(box, axis, above > below ? 1 : -1, growth);
  }
  return std::nullopt;
}

std::optional<Solid> CylinderThrough(const Solid& a, const Solid& b) {
  constexpr double kMinCos = 0.95;  // 18 degrees: the axis of a short piece is not well known
  const Eigen::Vector3d shift = b.X_CO.translation() - a.X_CO.translation();
  const double distance = shift.norm();
  const Eigen::Vector3d axis = a.X_CO.linear().col(2);
  const double along = axis.dot(shift) / std::max(1e-9, distance);
  if (std::abs(a.radius() - b.radius()) > kEdgeBlur || std::abs(along) < kMinCos ||
      std::abs(axis.dot(b.X_CO.linear().col(2))) < kMinCos) {
    return std::nullopt;
  }
  const Eigen::Vector3d direction = std::copysign(1 / distance, along) * shift;
  const double low = std::min(-0.5 * a.height(), std::copysign(distance, along) - 0.5 * b.height());
  const double high = std::max(0.5 * a.height(), std::copysign(distance, along) + 0.5 * b.height());
  if (high - low > kMaxExtent) return std::nullopt;
  Solid whole = a;
  whole.X_CO.linear() =
      Eigen::Quaterniond::FromTwoVectors(axis, direction).toRotationMatrix() * a.X_CO.linear();
  whole.X_CO.translation() += 0.5 * (low + high) * direction;
  whole.size.z() = high - low;
  return whole;
}

}  // namespace declutter
