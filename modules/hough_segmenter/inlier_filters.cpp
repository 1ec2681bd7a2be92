#include "modules/hough_segmenter/inlier_filters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace declutter {
namespace {

using Span = std::pair<float, float>;

// One value for each inlier.
template <typename Coordinate>
std::vector<float> Values(const std::vector<SideCell>& cells, const std::vector<int>& inliers,
                          Coordinate coordinate) {
  std::vector<float> values;
  values.reserve(inliers.size());
  for (int i : inliers) values.push_back(coordinate(cells[static_cast<size_t>(i)]));
  return values;
}

// Clusters of the inliers along one coordinate: where nothing lies for max_gap (to an eighth of
// it), a new one begins. Returns the clusters' spans, heaviest first.
std::vector<Span> Clusters(const std::vector<SideCell>& cells, const std::vector<int>& inliers,
                           const std::vector<float>& values, float max_gap) {
  constexpr int kBinsPerGap = 8;
  if (values.empty()) return {};
  struct Bin {
    float weight = 0;
    Span span = {std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest()};
  };
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const float bins_per_unit = kBinsPerGap / max_gap;
  std::vector<Bin> bins(static_cast<size_t>((*high - *low) * bins_per_unit) + 1);
  for (size_t k = 0; k < values.size(); ++k) {
    Bin& bin = bins[static_cast<size_t>((values[k] - *low) * bins_per_unit)];
    bin.weight += cells[static_cast<size_t>(inliers[k])].weight;
    bin.span = {std::min(bin.span.first, values[k]), std::max(bin.span.second, values[k])};
  }
  std::vector<Bin> clusters;
  int num_empty = kBinsPerGap;
  for (const Bin& bin : bins) {
    if (bin.weight == 0) {
      ++num_empty;
      continue;
    }
    if (num_empty >= kBinsPerGap) clusters.push_back({0, bin.span});
    num_empty = 0;
    clusters.back().weight += bin.weight;
    clusters.back().span.second = bin.span.second;
  }
  std::stable_sort(clusters.begin(), clusters.end(),
                   [](const Bin& x, const Bin& y) { return x.weight > y.weight; });
  std::vector<Span> spans;
  for (const Bin& cluster : clusters) spans.push_back(cluster.span);
  return spans;
}

template <typename Condition>
void KeepIf(const std::vector<SideCell>& cells, std::vector<int>* inliers, Condition condition) {
  inliers->erase(std::remove_if(inliers->begin(), inliers->end(),
                                [&](int i) { return !condition(cells[static_cast<size_t>(i)]); }),
                 inliers->end());
}

// Keeps the inliers whose values lie in one of the spans.
void KeepInside(const std::vector<float>& values, const std::vector<Span>& spans,
                std::vector<int>* inliers) {
  size_t num = 0;
  for (size_t k = 0; k < values.size(); ++k) {
    const auto is_inside = [x = values[k]](const Span& s) { return x >= s.first && x <= s.second; };
    if (std::any_of(spans.begin(), spans.end(), is_inside)) (*inliers)[num++] = (*inliers)[k];
  }
  inliers->resize(num);
}

}  // namespace

void KeepOneRun(const std::vector<SideCell>& cells, float max_gap_m, FeatureMode mode,
                LineFit* fit) {
  const Eigen::Vector2f t = fit->model.tangent();
  const std::vector<float> along =
      Values(cells, fit->inliers, [&t](const SideCell& cell) { return t.dot(cell.p); });
  std::vector<Span> runs = Clusters(cells, fit->inliers, along, max_gap_m);
  if (runs.size() <= 1) return;
  if (mode == FeatureMode::kPaper) {
    fit->inliers.clear();
    return;
  }
  runs.resize(1);
  KeepInside(along, runs, &fit->inliers);
}

void KeepOneHeight(const std::vector<SideCell>& cells, float max_gap_m, CircleFit* fit) {
  const std::vector<float> z =
      Values(cells, fit->inliers, [](const SideCell& cell) { return cell.z; });
  std::vector<Span> heights = Clusters(cells, fit->inliers, z, 2 * max_gap_m);
  if (heights.size() <= 1) return;
  heights.resize(1);
  KeepInside(z, heights, &fit->inliers);
}

void KeepArcs(const std::vector<SideCell>& cells, float max_gap_m, size_t max_arcs,
              CircleFit* fit) {
  // The camera sees at most half of the outside: angles around the mean direction do not wrap.
  Eigen::Vector2f mean = Eigen::Vector2f::Zero();
  for (int i : fit->inliers) {
    const SideCell& cell = cells[static_cast<size_t>(i)];
    mean += cell.weight * (cell.p - fit->model.c).normalized();
  }
  const Eigen::Vector2f across(-mean.y(), mean.x());
  const std::vector<float> angles = Values(cells, fit->inliers, [&](const SideCell& cell) {
    const Eigen::Vector2f q = cell.p - fit->model.c;
    return std::atan2(across.dot(q), mean.dot(q));
  });
  const float max_gap_rad = 2 * max_gap_m / std::max(fit->model.r, max_gap_m);
  std::vector<Span> arcs = Clusters(cells, fit->inliers, angles, max_gap_rad);
  if (arcs.size() > max_arcs) {
    arcs.resize(max_arcs);
    KeepInside(angles, arcs, &fit->inliers);
  }
  fit->model.arc = 0;
  for (const Span& arc : arcs) fit->model.arc += arc.second - arc.first;
}

void KeepOneRadius(const std::vector<SideCell>& cells, float max_step_m, CircleFit* fit) {
  constexpr float kMinShare = 0.15f;  // of the points on either side of a step
  constexpr float kLayer = 0.004f;    // [m] of height
  if (fit->inliers.empty()) return;
  const std::vector<float> z =
      Values(cells, fit->inliers, [](const SideCell& cell) { return cell.z; });
  const auto [low, high] = std::minmax_element(z.begin(), z.end());
  const auto layer_of = [low = *low](float height) {
    return static_cast<size_t>((height - low) / kLayer);
  };
  std::vector<Eigen::Vector2f> layers(layer_of(*high) + 1, Eigen::Vector2f::Zero());
  Eigen::Vector2f total = Eigen::Vector2f::Zero();  // weight, weight times radius
  for (size_t k = 0; k < z.size(); ++k) {
    const SideCell& cell = cells[static_cast<size_t>(fit->inliers[k])];
    const Eigen::Vector2f sums(cell.weight, cell.weight * (cell.p - fit->model.c).norm());
    layers[layer_of(z[k])] += sums;
    total += sums;
  }
  Eigen::Vector2f below = Eigen::Vector2f::Zero();
  float largest_step = max_step_m;
  size_t split = 0;
  bool keep_below = false;
  for (size_t layer = 0; layer + 1 < layers.size(); ++layer) {
    below += layers[layer];
    const Eigen::Vector2f above = total - below;
    if (below.x() < kMinShare * total.x() || above.x() < kMinShare * total.x()) continue;
    const float step = std::abs(below.y() / below.x() - above.y() / above.x());
    if (step <= largest_step) continue;
    largest_step = step;
    split = layer;
    keep_below = below.x() >= above.x();
  }
  if (largest_step <= max_step_m) return;
  KeepIf(cells, &fit->inliers,
         [&](const SideCell& cell) { return (layer_of(cell.z) <= split) == keep_below; });
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
