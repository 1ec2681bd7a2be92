#include "modules/plane_filter/outlier_filter.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "modules/plane_filter/pixel_kernels.h"

namespace declutter {
namespace {

// Average and spread over all marked pixels need about as many of them.
constexpr double kStatisticsPixels = 1000;

bool HasMarked(const uint8_t* row, int width) {
  return std::memchr(row, 1, static_cast<size_t>(width)) != nullptr;
}

// The points of an image, unmarked ones left out, with a margin that no window leaves. Distances
// are over the depth of the point that they are measured from.
class Points {
 public:
  Points(const InverseDepth& image, const PixelMask& mask, const PlaneFilterConfig& config)
      : width_(image.width),
        height_(image.height),
        half_width_(config.outlier_window_px() / 2),
        num_nearest_(static_cast<size_t>(config.outlier_neighbors())),
        margin_(std::max(half_width_, kMinMargin)),
        stride_(image.width + 2 * margin_ + static_cast<int>(kKernelPadding)),
        x_(static_cast<size_t>(stride_)),
        y_(static_cast<size_t>(image.height + 2 * margin_)),
        values_(static_cast<size_t>(stride_) * y_.size()) {
    std::copy(image.ray_x.begin(), image.ray_x.end(), x_.begin() + margin_);
    std::copy(image.ray_y.begin(), image.ray_y.end(), y_.begin() + margin_);
    for (int v = 0; v < image.height; ++v) {
      const float* from = &image.values[image.Index(0, v)];
      const uint8_t* marked = &mask[image.Index(0, v)];
      if (!HasMarked(marked, image.width)) continue;
      float* to = &values_[Index(0, v)];
      for (int u = 0; u < image.width; ++u) to[u] = from[u] * static_cast<float>(marked[u]);
    }
  }

  bool Has(int u, int v) const { return values_[Index(u, v)] > 0; }

  // Mean distance to the nearest points in the window.
  float MeanOfNearest(int u, int v) const {
    return declutter::MeanOfNearest(Row(v), static_cast<size_t>(u), half_width_, num_nearest_);
  }

  // Number of points within limit of each point of row v, as far as it is below num_nearest.
  void CountNear(int v, float limit, std::vector<int32_t>* counts) const {
    declutter::CountNear(Row(v), static_cast<size_t>(width_), half_width_, limit,
                         static_cast<int>(num_nearest_), counts->data());
  }

  int width() const { return width_; }
  int height() const { return height_; }

 private:
  static constexpr int kMinMargin = 2;  // [px] that CountNear always reads

  size_t Index(int u, int v) const {
    return static_cast<size_t>(v + margin_) * static_cast<size_t>(stride_) +
           static_cast<size_t>(u + margin_);
  }

  PointWindow Row(int v) const {
    return {&values_[Index(0, v)], stride_, &x_[static_cast<size_t>(margin_)],
            &y_[static_cast<size_t>(v + margin_)]};
  }

  int width_;
  int height_;
  int half_width_;
  size_t num_nearest_;
  int margin_;
  int stride_;
  std::vector<float> x_;
  std::vector<float> y_;
  std::vector<float> values_;
};

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

// The mean distance from which a point is an outlier. Outliers themselves are left out of the
// second estimate: a handful would set the limit.
float OutlierLimit(size_t num_marked, double sigmas, Points* points) {
  const int stride =
      std::max(1, static_cast<int>(std::sqrt(static_cast<double>(num_marked) / kStatisticsPixels)));
  std::vector<float> means;
  for (int v = 0; v < points->height(); v += stride) {
    for (int u = 0; u < points->width(); u += stride) {
      if (points->Has(u, v)) means.push_back(points->MeanOfNearest(u, v));
    }
  }
  constexpr double kAlone = 1e9;
  return static_cast<float>(LimitOf(means, sigmas, LimitOf(means, sigmas, kAlone)));
}

}  // namespace

PixelMask RemoveOutliers(const InverseDepth& image, const PixelMask& mask,
                         const PlaneFilterConfig& config) {
  Points points(image, mask, config);
  const auto num_marked = static_cast<size_t>(std::count(mask.begin(), mask.end(), 1));
  const float limit = OutlierLimit(num_marked, config.outlier_sigmas(), &points);
  PixelMask kept(mask.size());
  std::vector<int32_t> num_near(static_cast<size_t>(image.width) + kKernelPadding);
  for (int v = 0; v < image.height; ++v) {
    const uint8_t* marked = &mask[image.Index(0, v)];
    if (!HasMarked(marked, image.width)) continue;
    points.CountNear(v, limit, &num_near);
    for (int u = 0; u < image.width; ++u) {
      if (!marked[u] || !points.Has(u, v)) continue;
      // Enough points within limit keep the mean of the nearest ones below it.
      kept[image.Index(u, v)] = num_near[static_cast<size_t>(u)] >= config.outlier_neighbors() ||
                                points.MeanOfNearest(u, v) <= limit;
    }
  }
  return kept;
}

}  // namespace declutter
