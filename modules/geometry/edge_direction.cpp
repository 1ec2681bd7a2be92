#include "modules/geometry/edge_direction.h"

#include <algorithm>
#include <cmath>

namespace declutter {
namespace {

constexpr size_t kMinPoints = 20;   // of an edge that has a direction
constexpr size_t kMaxPoints = 160;  // that decide
constexpr int kSteps = 60;          // of 1.5 degrees
constexpr float kBin = 0.003f;      // [m] across a line: about two pixels at 1 m

// Sum of the squared numbers of points in windows of two bins of their positions along an axis:
// large when few lines across it hold them.
int Concentration(const std::vector<Eigen::Vector2f>& points, const Eigen::Vector2f& axis,
                  float low, std::vector<int>* windows) {
  std::fill(windows->begin(), windows->end(), 0);
  for (const Eigen::Vector2f& p : points) {
    const auto bin = static_cast<size_t>((axis.dot(p) - low) / kBin);
    ++(*windows)[bin];
    ++(*windows)[bin + 1];
  }
  int sum = 0;
  for (const int num : *windows) sum += num * num;
  return sum;
}

}  // namespace

std::optional<Eigen::Vector2f> EdgeDirection(const std::vector<Eigen::Vector2f>& edge) {
  if (edge.size() < kMinPoints) return std::nullopt;
  const size_t stride = edge.size() / kMaxPoints + 1;
  std::vector<Eigen::Vector2f> points;
  Eigen::Vector2f mean = Eigen::Vector2f::Zero();
  for (size_t i = 0; i < edge.size(); i += stride) {
    points.push_back(edge[i]);
    mean += edge[i];
  }
  mean /= static_cast<float>(points.size());
  float reach = 0;
  for (Eigen::Vector2f& p : points) {
    p -= mean;
    reach = std::max(reach, p.norm());
  }
  std::vector<int> windows(static_cast<size_t>(2 * reach / kBin) + 3);
  Eigen::Vector2f best = Eigen::Vector2f::UnitX();
  int best_sum = 0;
  for (int step = 0; step < kSteps; ++step) {
    const auto angle = static_cast<float>(step * M_PI / 2 / kSteps);
    const Eigen::Vector2f axis(std::cos(angle), std::sin(angle));
    const int sum = Concentration(points, axis, -reach, &windows) +
                    Concentration(points, {-axis.y(), axis.x()}, -reach, &windows);
    if (sum <= best_sum) continue;
    best_sum = sum;
    best = axis;
  }
  return best;
}

}  // namespace declutter
