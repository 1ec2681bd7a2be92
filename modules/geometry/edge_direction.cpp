#include "modules/geometry/edge_direction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace declutter {
namespace {

constexpr size_t kMinPoints = 20;   // of an edge that has a direction
constexpr size_t kMaxPoints = 160;  // that decide
constexpr int kSteps = 60;          // of 1.5 degrees
constexpr float kBin = 0.003f;      // [m] across a line: about two pixels at 1 m
constexpr size_t kMaxBins = 1024;   // 3 m, more than stands on a table

// Points of an edge about their mean, each coordinate in an array of its own.
struct EdgePoints {
  std::array<float, kMaxPoints> x, y;
  size_t num = 0;
};

// Sum of the squared numbers of points in windows of two bins of their positions along an axis:
// large when few lines across it hold them.
int Concentration(const EdgePoints& points, const Eigen::Vector2f& axis, float low,
                  size_t num_bins) {
  std::array<int32_t, kMaxPoints> bins;
  for (size_t i = 0; i < points.num; ++i) {
    bins[i] = static_cast<int32_t>((axis.x() * points.x[i] + axis.y() * points.y[i] - low) / kBin);
  }
  std::array<int16_t, kMaxBins + 2> num_in_bin;  // from the second on, the others are empty
  std::fill_n(num_in_bin.begin(), num_bins + 2, int16_t{0});
  for (size_t i = 0; i < points.num; ++i) ++num_in_bin[static_cast<size_t>(bins[i]) + 1];
  int sum = 0;
  for (size_t k = 0; k <= num_bins; ++k) {
    const int num = num_in_bin[k] + num_in_bin[k + 1];
    sum += num * num;
  }
  return sum;
}

}  // namespace

std::optional<Eigen::Vector2f> EdgeDirection(const std::vector<Eigen::Vector2f>& edge) {
  if (edge.size() < kMinPoints) return std::nullopt;
  const size_t stride = edge.size() / kMaxPoints + 1;
  Eigen::Vector2f mean = Eigen::Vector2f::Zero();
  EdgePoints points;
  for (size_t i = 0; i < edge.size(); i += stride) {
    mean += edge[i];
    ++points.num;
  }
  mean /= static_cast<float>(points.num);
  float reach = 0;
  for (size_t i = 0; i < points.num; ++i) {
    const Eigen::Vector2f p = edge[i * stride] - mean;
    points.x[i] = p.x();
    points.y[i] = p.y();
    reach = std::max(reach, p.norm());
  }
  const auto num_bins = static_cast<size_t>(2 * reach / kBin) + 2;
  if (num_bins > kMaxBins) return std::nullopt;
  Eigen::Vector2f best = Eigen::Vector2f::UnitX();
  int best_sum = 0;
  for (int step = 0; step < kSteps; ++step) {
    const auto angle = static_cast<float>(step * M_PI / 2 / kSteps);
    const Eigen::Vector2f axis(std::cos(angle), std::sin(angle));
    const int sum = Concentration(points, axis, -reach, num_bins) +
                    Concentration(points, {-axis.y(), axis.x()}, -reach, num_bins);
    if (sum <= best_sum) continue;
    best_sum = sum;
    best = axis;
  }
  return best;
}

}  // namespace declutter
