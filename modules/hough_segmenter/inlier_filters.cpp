#include "modules/hough_segmenter/inlier_filters.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "modules/geometry/marked_pixels.h"

namespace declutter {
namespace {

constexpr size_t kBinsPerGap = 8;
using Field = CellArrays::Field;

}  // namespace

template <typename Condition>
void InlierFilters::KeepIf(Condition condition, CellArrays* inliers) {
  marks_.resize(inliers->size() + kCellBlock);
  for (size_t i = 0; i < inliers->size(); ++i) marks_[i] = condition(i) ? 1.0f : 0.0f;
  inliers->KeepMarked(marks_);
}

bool InlierFilters::HasAtMost(size_t max_num, float max_gap, const CellArrays& inliers) {
  clusters_.clear();
  if (inliers.empty()) return true;
  const size_t num = inliers.size();
  range_ = RangeOf(values_.data(), num);
  const float bins_per_unit = static_cast<float>(kBinsPerGap) / max_gap;
  const auto bin_of = [=](float value) {
    return static_cast<int32_t>((value - range_.low) * bins_per_unit);
  };
  const auto num_bins = static_cast<size_t>(bin_of(range_.high)) + 1;
  bins_.resize(num);
  for (size_t i = 0; i < num; ++i) bins_[i] = bin_of(values_[i]);
  is_used_.assign(num_bins, 0);
  for (const int32_t bin : bins_) is_used_[static_cast<size_t>(bin)] = 1;
  ForEachMarked(is_used_.data(), 0, num_bins, [this](size_t bin) {
    if (clusters_.empty() || bin > clusters_.back().last_bin + kBinsPerGap) {
      clusters_.push_back({bin, bin, 0});
    }
    clusters_.back().last_bin = bin;
  });
  if (clusters_.size() <= max_num) return true;
  KeepHeaviest(max_num, inliers);
  return false;
}

void InlierFilters::KeepHeaviest(size_t max_num, const CellArrays& inliers) {
  bin_weights_.assign(is_used_.size(), 0);
  const float* weight = inliers.field(Field::kWeight);
  for (size_t i = 0; i < inliers.size(); ++i) {
    bin_weights_[static_cast<size_t>(bins_[i])] += weight[i];
  }
  for (Cluster& cluster : clusters_) {
    for (size_t bin = cluster.first_bin; bin <= cluster.last_bin; ++bin) {
      cluster.weight += bin_weights_[bin];
    }
  }
  std::partial_sort(clusters_.begin(), clusters_.begin() + static_cast<std::ptrdiff_t>(max_num),
                    clusters_.end(), [](const Cluster& a, const Cluster& b) {
                      return a.weight != b.weight ? a.weight > b.weight : a.first_bin < b.first_bin;
                    });
  clusters_.resize(max_num);
}

void InlierFilters::KeepClusters(CellArrays* inliers) {
  std::fill(is_used_.begin(), is_used_.end(), uint8_t{0});
  for (const Cluster& cluster : clusters_) {
    const auto begin = is_used_.begin();
    std::fill(begin + static_cast<std::ptrdiff_t>(cluster.first_bin),
              begin + static_cast<std::ptrdiff_t>(cluster.last_bin) + 1, uint8_t{1});
  }
  KeepIf([this](size_t i) { return is_used_[static_cast<size_t>(bins_[i])] != 0; }, inliers);
}

float InlierFilters::SpanOf(const Cluster& cluster) const {
  if (cluster.first_bin == 0 && cluster.last_bin + 1 == is_used_.size()) {
    return range_.high - range_.low;
  }
  Range span{std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest()};
  for (size_t i = 0; i < bins_.size(); ++i) {
    const auto bin = static_cast<size_t>(bins_[i]);
    if (bin < cluster.first_bin || bin > cluster.last_bin) continue;
    span = {std::min(span.low, values_[i]), std::max(span.high, values_[i])};
  }
  return span.high - span.low;
}

void InlierFilters::KeepOneRun(const LineModel& line, float max_gap_m, FeatureMode mode,
                               CellArrays* inliers) {
  const Eigen::Vector2f t = line.tangent();
  values_.resize(inliers->size() + kCellBlock);
  PositionsAlong(inliers->field(Field::kX), inliers->field(Field::kY), inliers->size(), t.x(),
                 t.y(), values_.data());
  if (HasAtMost(1, max_gap_m, *inliers)) return;
  if (mode == FeatureMode::kPaper) {
    inliers->Resize(0);
  } else {
    KeepClusters(inliers);
  }
}

void InlierFilters::KeepOneHeight(float max_gap_m, CellArrays* inliers) {
  const float* z = inliers->field(Field::kZ);
  values_.assign(z, z + inliers->size() + kCellBlock);
  if (!HasAtMost(1, 2 * max_gap_m, *inliers)) KeepClusters(inliers);
}

void InlierFilters::KeepArcs(float max_gap_m, size_t max_arcs, CircleModel* circle,
                             CellArrays* inliers) {
  const float* x = inliers->field(Field::kX);
  const float* y = inliers->field(Field::kY);
  const size_t num = inliers->size();
  // The camera sees at most half of the outside: angles around the mean direction do not wrap.
  const PointSums sums =
      SumPoints(x, y, inliers->field(Field::kWeight), num, circle->c.x(), circle->c.y());
  const Eigen::Vector2f mean = Eigen::Vector2f(sums.x, sums.y).normalized();
  values_.resize(num + kCellBlock);
  Angles(x, y, num, circle->c.x(), circle->c.y(), mean.x(), mean.y(), values_.data());
  const float max_gap_rad = 2 * max_gap_m / std::max(circle->r, max_gap_m);
  const bool has_few = HasAtMost(max_arcs, max_gap_rad, *inliers);
  circle->arc = 0;
  for (const Cluster& cluster : clusters_) circle->arc += SpanOf(cluster);
  if (!has_few) KeepClusters(inliers);
}

void InlierFilters::KeepOneRadius(const CircleModel& circle, float max_step_m,
                                  CellArrays* inliers) {
  constexpr float kMinShare = 0.15f;  // of the points on either side of a step
  constexpr float kLayer = 0.004f;    // [m] of height
  const size_t num = inliers->size();
  if (num == 0) return;
  values_.resize(num + kCellBlock);
  Distances(inliers->field(Field::kX), inliers->field(Field::kY), num, circle.c.x(), circle.c.y(),
            values_.data());
  const float* z = inliers->field(Field::kZ);
  const float* weight = inliers->field(Field::kWeight);
  const Range range = RangeOf(z, num);
  const auto layer_of = [low = range.low](float height) {
    return static_cast<size_t>((height - low) / kLayer);
  };
  layers_.assign(layer_of(range.high) + 1, Eigen::Vector2f::Zero());
  Eigen::Vector2f total = Eigen::Vector2f::Zero();  // weight, weight times radius
  for (size_t i = 0; i < num; ++i) {
    const Eigen::Vector2f sums(weight[i], weight[i] * values_[i]);
    layers_[layer_of(z[i])] += sums;
    total += sums;
  }
  Eigen::Vector2f below = Eigen::Vector2f::Zero();
  float largest_step = max_step_m;
  size_t split = 0;
  bool keep_below = false;
  for (size_t layer = 0; layer + 1 < layers_.size(); ++layer) {
    below += layers_[layer];
    const Eigen::Vector2f above = total - below;
    if (below.x() < kMinShare * total.x() || above.x() < kMinShare * total.x()) continue;
    const float step = std::abs(below.y() / below.x() - above.y() / above.x());
    if (step <= largest_step) continue;
    largest_step = step;
    split = layer;
    keep_below = below.x() >= above.x();
  }
  if (largest_step <= max_step_m) return;
  KeepIf([&](size_t i) { return (layer_of(z[i]) <= split) == keep_below; }, inliers);
}

void InlierFilters::KeepFlat(float max_curvature, CellArrays* inliers) {
  const float* curvature = inliers->field(Field::kCurvature);
  KeepIf([&](size_t i) { return curvature[i] <= max_curvature; }, inliers);
}

void InlierFilters::KeepRound(const CircleModel& circle, float max_curvature,
                              float max_radius_difference_m, CellArrays* inliers) {
  const float* curvature = inliers->field(Field::kCurvature);
  const float* r_min = inliers->field(Field::kMinRadius);
  KeepIf(
      [&](size_t i) {
        return curvature[i] > max_curvature &&
               std::abs(r_min[i] - circle.r) <= max_radius_difference_m;
      },
      inliers);
}

bool IsMedianKappaBelow(float limit, const CellArrays& inliers) {
  return WeightBelow(inliers.field(Field::kKappa), inliers.field(Field::kWeight), inliers.size(),
                     limit) >= 0.5f * inliers.NumPoints();
}

}  // namespace declutter
