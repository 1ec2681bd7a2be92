#include "modules/model_verifier/box_splitting.h"

#include <algorithm>

#include "modules/model_verifier/extents.h"

namespace declutter {
namespace {

constexpr int kNumCuts = 12;         // steps along each side between which a box may be cut
constexpr int kNumFineCuts = 8;      // of each of those around the best
constexpr size_t kMinPoints = 20;    // of a part
constexpr double kMaxArea = 0.9;     // of the box that both parts may have together
constexpr double kOutermost = 0.01;  // share of the points that may lie beyond an end

// A rectangle seen from above, in O.
struct Footprint {
  Eigen::Vector2d low;
  Eigen::Vector2d high;

  double area() const { return (high - low).prod(); }
};

using Coordinates = std::array<std::vector<double>, 2>;  // x and y of points

std::array<double, 2> Ends(std::vector<double>* values) {
  const auto quantile = [&](double share) {
    const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values->size() - 1));
    std::nth_element(values->begin(), values->begin() + rank, values->end());
    return (*values)[static_cast<size_t>(rank)];
  };
  return {quantile(kOutermost), quantile(1 - kOutermost)};
}

// Around the points with from < coordinate along the axis <= to; nothing when they are few.
std::optional<Footprint> Around(const std::vector<Eigen::Vector3d>& points_O, int axis, double from,
                                double to, Coordinates* buffer) {
  Coordinates& values = *buffer;
  for (std::vector<double>& along : values) along.clear();
  for (const Eigen::Vector3d& p : points_O) {
    if (p[axis] <= from || p[axis] > to) continue;
    values[0].push_back(p.x());
    values[1].push_back(p.y());
  }
  if (values[0].size() < kMinPoints) return std::nullopt;
  const auto x = Ends(&values[0]);
  const auto y = Ends(&values[1]);
  const Footprint footprint = {{x[0], y[0]}, {x[1], y[1]}};
  if ((footprint.high - footprint.low).minCoeff() < kMinExtent) return std::nullopt;
  return footprint;
}

Solid BoxOver(const Footprint& footprint, const Solid& box) {
  Solid part = box;
  const Eigen::Vector2d centre = 0.5 * (footprint.low + footprint.high);
  part.X_CO = box.X_CO * Eigen::Translation3d(centre.x(), centre.y(), 0);
  part.size.head<2>() = footprint.high - footprint.low;
  return part;
}

}  // namespace

std::optional<std::array<Solid, 2>> BoxSplitter::Split(
    const Solid& box, const std::vector<Eigen::Vector3d>& points_O) {
  std::optional<std::array<Solid, 2>> best;
  double best_area = kMaxArea * box.size.x() * box.size.y();
  int best_axis = 0;
  double best_cut = 0;
  const auto cut_at = [&](int axis, double cut) {
    const auto lower = Around(points_O, axis, -box.size[axis], cut, &coordinates_);
    const auto upper = Around(points_O, axis, cut, box.size[axis], &coordinates_);
    if (!lower || !upper || lower->area() + upper->area() >= best_area) return;
    best_area = lower->area() + upper->area();
    best_axis = axis;
    best_cut = cut;
    best = {BoxOver(*lower, box), BoxOver(*upper, box)};
  };
  for (int axis = 0; axis < 2; ++axis) {
    const double step = box.size[axis] / kNumCuts;
    for (int k = 1; k < kNumCuts; ++k) cut_at(axis, k * step - 0.5 * box.size[axis]);
  }
  if (!best) return best;
  const double coarse_cut = best_cut;
  const double step = box.size[best_axis] / (kNumCuts * kNumFineCuts);
  for (int k = 1; k < kNumFineCuts; ++k) {
    for (const double sign : {-1, 1}) cut_at(best_axis, coarse_cut + sign * k * step);
  }
  return best;
}

}  // namespace declutter
