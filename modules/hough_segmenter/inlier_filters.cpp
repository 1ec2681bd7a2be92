#include "modules/hough_segmenter/inlier_filters.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace declutter {
namespace {

using Span = std::pair<float, float>;

// Clusters of the inliers along one coordinate: values further apart than max_gap fall into two.
// Returns the cluster's span for each, heaviest first.
template <typename Coordinate>
std::vector<Span> Clusters(const std::vector<SideCell>& cells, const std::vector<int>& inliers,
                           float max_gap, Coordinate coordinate) {
  std::vector<std::pair<float, float>> values;  // coordinate, weight
  values.reserve(inliers.size());
  for (int i : inliers) {
    const SideCell& cell = cells[static_cast<size_t>(i)];
    values.emplace_back(coordinate(cell), cell.weight);
  }
  std::sort(values.begin(), values.end());
  std::vector<std::pair<float, Span>> clusters;  // weight, span
  for (const auto& [value, weight] : values) {
    if (clusters.empty() || value - clusters.back().second.second > max_gap) {
      clusters.push_back({0.0f, {value, value}});
    }
    clusters.back().first += weight;
    clusters.back().second.second = value;
  }
  std::stable_sort(clusters.begin(), clusters.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Span> spans;
  for (const auto& cluster : clusters) spans.push_back(cluster.second);
  return spans;
}

template <typename Condition>
void KeepIf(const std::vector<SideCell>& cells, std::vector<int>* inliers, Condition condition) {
  inliers->erase(std::remove_if(inliers->begin(), inliers->end(),
                                [&](int i) { return !condition(cells[static_cast<size_t>(i)]); }),
                 inliers->end());
}

}  // namespace

void KeepOneRun(const std::vector<SideCell>& cells, float max_gap_m, FeatureMode mode,
                LineFit* fit) {
  const Eigen::Vector2f t = fit->model.tangent();
  const auto along = [&t](const SideCell& cell) { return t.dot(cell.p); };
  const std::vector<Span> runs = Clusters(cells, fit->inliers, max_gap_m, along);
  if (runs.empty()) return;
  if (mode == FeatureMode::kPaper && runs.size() > 1) {
    fit->inliers.clear();
    return;
  }
  KeepIf(cells, &fit->inliers, [&](const SideCell& cell) {
    return along(cell) >= runs[0].first && along(cell) <= runs[0].second;
  });
}

void KeepOneHeight(const std::vector<SideCell>& cells, float max_gap_m, CircleFit* fit) {
  const auto height = [](const SideCell& cell) { return cell.z; };
  const std::vector<Span> heights = Clusters(cells, fit->inliers, 2 * max_gap_m, height);
  if (heights.empty()) return;
  KeepIf(cells, &fit->inliers, [&](const SideCell& cell) {
    return cell.z >= heights[0].first && cell.z <= heights[0].second;
  });
}

void KeepArcs(const std::vector<SideCell>& cells, float max_gap_m, size_t max_arcs,
              CircleFit* fit) {
  // The camera sees at most half of the outside: angles around the mean direction do not wrap.
  Eigen::Vector2f mean = Eigen::Vector2f::Zero();
  for (int i : fit->inliers) {
    const SideCell& cell = cells[static_cast<size_t>(i)];
    mean += cell.weight * (cell.p - fit->model.c).normalized();
  }
  const float reference = std::atan2(mean.y(), mean.x());
  const auto angle = [&](const SideCell& cell) {
    const Eigen::Vector2f q = cell.p - fit->model.c;
    return std::remainder(std::atan2(q.y(), q.x()) - reference, 2 * static_cast<float>(M_PI));
  };
  const float max_gap_rad = 2 * max_gap_m / std::max(fit->model.r, max_gap_m);
  std::vector<Span> arcs = Clusters(cells, fit->inliers, max_gap_rad, angle);
  if (arcs.size() > max_arcs) {
    arcs.resize(max_arcs);
    KeepIf(cells, &fit->inliers, [&](const SideCell& cell) {
      const float a = angle(cell);
      return std::any_of(arcs.begin(), arcs.end(),
                         [a](const Span& arc) { return a >= arc.first && a <= arc.second; });
    });
  }
  fit->model.arc = 0;
  for (const Span& arc : arcs) fit->model.arc += arc.second - arc.first;
}

void KeepOneRadius(const std::vector<SideCell>& cells, float max_step_m, CircleFit* fit) {
  constexpr float kMinShare = 0.15f;  // of the points on either side of a step
  std::vector<int> by_height = fit->inliers;
  const auto height = [&](int i) { return cells[static_cast<size_t>(i)].z; };
  std::sort(by_height.begin(), by_height.end(),
            [&](int a, int b) { return std::pair(height(a), a) < std::pair(height(b), b); });
  const auto sums = [&](int i) {
    const SideCell& cell = cells[static_cast<size_t>(i)];
    return Eigen::Vector2f(cell.weight, cell.weight * (cell.p - fit->model.c).norm());
  };
  Eigen::Vector2f total = Eigen::Vector2f::Zero();
  for (int i : by_height) total += sums(i);
  Eigen::Vector2f below = Eigen::Vector2f::Zero();
  float largest_step = max_step_m;
  float split_height = 0;
  bool keep_below = false;
  for (size_t k = 0; k + 1 < by_height.size(); ++k) {
    below += sums(by_height[k]);
    const Eigen::Vector2f above = total - below;
    if (below.x() < kMinShare * total.x() || above.x() < kMinShare * total.x()) continue;
    const float step = std::abs(below.y() / below.x() - above.y() / above.x());
    if (step <= largest_step) continue;
    largest_step = step;
    split_height = height(by_height[k]);
    keep_below = below.x() >= above.x();
  }
  if (largest_step <= max_step_m) return;
  KeepIf(cells, &fit->inliers,
         [&](const SideCell& cell) { return (cell.z <= split_height) == keep_below; });
}

void KeepFlat(const std::vector<SideCell>& cells, float max_curvature, LineFit* fit) {
  KeepIf(cells, &fit->inliers,
         [&](const SideCell& cell) { return cell.curvature <= max_curvature; });
}

void KeepRound(const std::vector<SideCell>& cells, float max_curvature,
               float max_radius_difference_m, CircleFit* fit) {
  KeepIf(cells, &fit->inliers, [&](const SideCell& cell) {
    return cell.curvature > max_curvature &&
           std::abs(cell.r_min - fit->model.r) <= max_radius_difference_m;
  });
}

float MedianKappa(const std::vector<SideCell>& cells, const std::vector<int>& inliers) {
  std::vector<std::pair<float, float>> values;  // kappa, weight
  float total = 0;
  for (int i : inliers) {
    const SideCell& cell = cells[static_cast<size_t>(i)];
    values.emplace_back(cell.kappa, cell.weight);
    total += cell.weight;
  }
  std::sort(values.begin(), values.end());
  float sum = 0;
  for (const auto& [kappa, weight] : values) {
    sum += weight;
    if (sum >= 0.5f * total) return kappa;
  }
  return 0;
}

float NumPoints(const std::vector<SideCell>& cells, const std::vector<int>& inliers) {
  float sum = 0;
  for (int i : inliers) sum += cells[static_cast<size_t>(i)].weight;
  return sum;
}

}  // namespace declutter
