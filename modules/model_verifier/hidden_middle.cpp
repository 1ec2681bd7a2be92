#include "modules/model_verifier/hidden_middle.h"

#include <algorithm>
#include <limits>

namespace declutter {
namespace {

constexpr double kEdgeBlur = 0.010;  // [m] by which what is measured around an edge is off
constexpr double kMaxExtent = 0.40;  // [m]

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

std::optional<Solid> ProlongedOver(const std::vector<Eigen::Vector3d>& points_O, Solid solid) {
  const bool is_box = solid.shape == Shape::kBox;
  const Eigen::Vector3d half = 0.5 * solid.size;
  for (int axis = is_box ? 0 : 2; axis < (is_box ? 2 : 3); ++axis) {
    const auto range = RangeAlong(axis, points_O, half);
    if (!range) continue;
    const double above = range->high - half[axis];
    const double below = -half[axis] - range->low;
    if ((above > kEdgeBlur) == (below > kEdgeBlur)) continue;
    const double growth = std::max(above, below);
    if (solid.size[axis] + growth > kMaxExtent) continue;
    solid.size[axis] += growth;
    solid.X_CO.translation() +=
        (above > below ? 0.5 : -0.5) * growth * solid.X_CO.linear().col(axis);
    return solid;
  }
  return std::nullopt;
}

}  // namespace declutter
