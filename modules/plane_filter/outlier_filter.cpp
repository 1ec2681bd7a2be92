#include "modules/plane_filter/outlier_filter.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "modules/geometry/for_each_processor.h"
#include "modules/geometry/marked_pixels.h"

namespace declutter {
namespace {

// Average and spread over all marked pixels need about as many of them.
constexpr double kStatisticsPixels = 1000;

constexpr int kMinMargin = 2;  // [px] that CountNear always reads

bool HasMarked(const uint8_t* row, int width) {
  return std::memchr(row, 1, static_cast<size_t>(width)) != nullptr;
}

DECLUTTER_FOR_EACH_PROCESSOR int NumMarked(const uint8_t* mask, size_t num) {
  int num_marked = 0;
  for (size_t i = 0; i < num; ++i) num_marked += mask[i];
  return num_marked;
}

// 0 where not marked.
DECLUTTER_FOR_EACH_PROCESSOR void Select(const float* values, const uint8_t* marked, size_t num,
                                         float* selected) {
  for (size_t i = 0; i < num; ++i) selected[i] = marked[i] > 0 ? values[i] : 0;
}

// Marks what is marked and has enough points near.
DECLUTTER_FOR_EACH_PROCESSOR void MarkEnough(const int32_t* num_near, const uint8_t* marked,
                                             size_t num, int enough, uint8_t* with_enough) {
  for (size_t i = 0; i < num; ++i) {
    with_enough[i] = num_near[i] >= enough ? marked[i] : uint8_t{0};
  }
}

// Marks what of a is not in b.
DECLUTTER_FOR_EACH_PROCESSOR void Without(const uint8_t* a, const uint8_t* b, size_t num,
                                          uint8_t* without) {
  for (size_t i = 0; i < num; ++i) without[i] = a[i] > b[i];
}

// sigmas standard deviations above the average of the values up to max_value.
double LimitOf(const std::vector<float>& values, double sigmas, double max_value) {
  double count = 0;
  double sum = 0;
  double sum_squares = 0;
  for (const double value : values) {
    if (value > max_value) continue;
    ++count;
    sum += value;
    sum_squares += value * value;
  }
  if (count == 0) return 0;
  const double average = sum / count;
  return average + sigmas * std::sqrt(std::max(sum_squares / count - average * average, 0.0));
}

}  // namespace

OutlierFilter::OutlierFilter(const PlaneFilterConfig& config)
    : half_width_(config.outlier_window_px() / 2),
      num_nearest_(static_cast<size_t>(config.outlier_neighbors())),
      sigmas_(config.outlier_sigmas()),
      margin_(std::max(half_width_, kMinMargin)) {}

void OutlierFilter::CopyMarked(const InverseDepth& image, const PixelMask& mask) {
  const auto margin = static_cast<size_t>(margin_);
  const auto width = static_cast<size_t>(image.width);
  const size_t stride = width + 2 * margin + kKernelPadding;
  x_.assign(stride, 0);
  y_.assign(static_cast<size_t>(image.height) + 2 * margin, 0);
  std::copy(image.ray_x.begin(), image.ray_x.end(), x_.begin() + margin_);
  std::copy(image.ray_y.begin(), image.ray_y.end(), y_.begin() + margin_);
  values_.resize(stride * y_.size());
  stride_ = static_cast<int>(stride);
  for (size_t row = 0; row < y_.size(); ++row) {
    float* to = &values_[row * stride];
    const bool is_margin = row < margin || row >= y_.size() - margin;
    const size_t begin = is_margin ? 0 : (row - margin) * width;
    if (is_margin || !HasMarked(&mask[begin], image.width)) {
      std::fill_n(to, stride, 0.0f);
      continue;
    }
    std::fill_n(to, margin, 0.0f);
    to += margin;
    Select(&image.values[begin], &mask[begin], width, to);
    std::fill_n(to + width, margin + kKernelPadding, 0.0f);
  }
}

PointWindow OutlierFilter::Row(int v) const {
  const size_t row = static_cast<size_t>(v + margin_);
  const auto margin = static_cast<size_t>(margin_);
  return {&values_[row * static_cast<size_t>(stride_) + margin], stride_, &x_[margin], &y_[row]};
}

float OutlierFilter::MeanOfNearest(size_t u, int v, float guess) const {
  return declutter::MeanOfNearest(Row(v), u, half_width_, num_nearest_, guess);
}

// The mean distance from which a point is an outlier. Outliers themselves are left out of the
// second estimate: a handful would set the limit.
float OutlierFilter::MaxMeanDistance(const InverseDepth& image, const PixelMask& mask) {
  const double num_marked = NumMarked(mask.data(), mask.size());
  const int stride = std::max(1, static_cast<int>(std::sqrt(num_marked / kStatisticsPixels)));
  means_.clear();
  for (int v = 0; v < image.height; v += stride) {
    const float* values = Row(v).values;
    for (int u = 0; u < image.width; u += stride) {
      if (values[u] <= 0) continue;
      // Of the points of a surface the farthest of the nearest is this much farther than the mean,
      // or more.
      constexpr float kFarthest = 1.2f;
      const float guess = means_.empty() ? 0 : kFarthest * means_.back();
      means_.push_back(MeanOfNearest(static_cast<size_t>(u), v, guess));
    }
  }
  constexpr double kAlone = 1e9;
  return static_cast<float>(LimitOf(means_, sigmas_, LimitOf(means_, sigmas_, kAlone)));
}

const PixelMask& OutlierFilter::Filter(const InverseDepth& image, const PixelMask& mask) {
  CopyMarked(image, mask);
  const float limit = MaxMeanDistance(image, mask);
  const auto width = static_cast<size_t>(image.width);
  const auto enough = static_cast<int>(num_nearest_);
  num_near_.resize(width + kKernelPadding);
  doubtful_.resize(width);
  kept_.assign(mask.size(), 0);
  for (int v = 0; v < image.height; ++v) {
    const uint8_t* marked = &mask[image.Index(0, v)];
    if (!HasMarked(marked, image.width)) continue;
    const PointWindow row = Row(v);
    CountNear(row, width, half_width_, limit, enough, num_near_.data());
    uint8_t* kept = &kept_[image.Index(0, v)];
    // Enough points within limit keep the mean of the nearest ones below it.
    MarkEnough(num_near_.data(), marked, width, enough, kept);
    Without(marked, kept, width, doubtful_.data());
    ForEachMarked(doubtful_.data(), 0, width, [&](size_t u) {
      kept[u] = row.values[u] > 0 && MeanOfNearest(u, v, limit) <= limit;
    });
  }
  return kept_;
}

}  // namespace declutter
