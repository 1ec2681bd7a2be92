#include "modules/plane_filter/outlier_filter.h"

#include <algorithm>
#include <cmath>

namespace declutter {
namespace {

// Average and spread over all marked pixels need about as many of them.
constexpr double kStatisticsPixels = 1000;

// Half width of the part of the window where near neighbours are counted [px].
constexpr int kNearHalfWidth = 2;

// The points of an image, unmarked ones left out. Distances are over the depth of the point that
// they are measured from.
class Points {
 public:
  Points(const InverseDepth& image, const PixelMask& mask, const PlaneFilterConfig& config)
      : image_(image),
        half_width_(config.outlier_window_px() / 2),
        num_nearest_(static_cast<size_t>(config.outlier_neighbors())) {
    for (size_t i = 0; i < mask.size(); ++i) image_.values[i] *= mask[i];
  }

  bool Has(int u, int v) const { return image_.values[image_.Index(u, v)] > 0; }

  // Mean distance to the nearest points in the window. Where it has too few, the missing ones count
  // as far as the farthest that there is; a point alone is infinitely far.
  float MeanOfNearest(int u, int v) {
    FindNeighbors(u, v);
    return MeanOfNearest();
  }

  // Whether the mean distance to the nearest points in the window is above limit.
  bool IsOutlier(int u, int v, float limit) {
    FindNeighbors(u, v);
    const auto num_near = std::count_if(squares_.begin(), squares_.end(),
                                        [&](float square) { return square < limit * limit; });
    // Enough points within limit keep the mean of the nearest ones below it.
    return static_cast<size_t>(num_near) < num_nearest_ && MeanOfNearest() > limit;
  }

  // Number of points within limit of each point of row v, between columns first and last, in a part
  // of the window. Plain loops over rows: this runs for all pixels.
  void CountNear(int v, int first, int last, float limit, std::vector<int>* counts) const {
    counts->assign(static_cast<size_t>(image_.width), 0);
    int* count = counts->data();
    const float* values = &image_.values[image_.Index(0, v)];
    for (int dv = -kNearHalfWidth; dv <= kNearHalfWidth; ++dv) {
      if (v + dv < 0 || v + dv >= image_.height) continue;
      const float* others = &image_.values[image_.Index(0, v + dv)];
      for (int du = -kNearHalfWidth; du <= kNearHalfWidth; ++du) {
        if (du == 0 && dv == 0) continue;
        const int end = std::min(last, image_.width - 1 - du);
        for (int u = std::max(first, -du); u <= end; ++u) {
          const float other = others[u + du];
          const float limit_square = limit * limit * other * other;
          // A missing point is at 0 and never near.
          count[u] += Square(u, v, values[u], u + du, v + dv, other) < limit_square;
        }
      }
    }
  }

 private:
  // Fills squares_ with the squared distances to the other points in the window.
  void FindNeighbors(int u, int v) {
    squares_.clear();
    const float value = image_.values[image_.Index(u, v)];
    const int last_v = std::min(v + half_width_, image_.height - 1);
    const int last_u = std::min(u + half_width_, image_.width - 1);
    for (int other_v = std::max(v - half_width_, 0); other_v <= last_v; ++other_v) {
      for (int other_u = std::max(u - half_width_, 0); other_u <= last_u; ++other_u) {
        const float other = image_.values[image_.Index(other_u, other_v)];
        if (other <= 0 || (other_u == u && other_v == v)) continue;
        squares_.push_back(Square(u, v, value, other_u, other_v, other) / (other * other));
      }
    }
  }

  float MeanOfNearest() {
    if (squares_.empty()) return HUGE_VALF;
    const size_t num = std::min(squares_.size(), num_nearest_);
    const auto farthest = squares_.begin() + static_cast<std::ptrdiff_t>(num) - 1;
    std::nth_element(squares_.begin(), farthest, squares_.end());
    float sum = std::sqrt(*farthest) * static_cast<float>(num_nearest_ - num);
    for (size_t i = 0; i < num; ++i) sum += std::sqrt(squares_[i]);
    return sum / static_cast<float>(num_nearest_);
  }

  // Squared distance of two points, over the squared depth of the first, times the squared inverse
  // depth of the second: no division.
  float Square(int u, int v, float value, int other_u, int other_v, float other) const {
    const float* x = image_.ray_x.data();
    const float* y = image_.ray_y.data();
    const float dx = x[other_u] * value - x[u] * other;
    const float dy = y[other_v] * value - y[v] * other;
    const float dz = value - other;
    return dx * dx + dy * dy + dz * dz;
  }

  InverseDepth image_;
  int half_width_;
  size_t num_nearest_;
  std::vector<float> squares_;
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
float OutlierLimit(const InverseDepth& image, const PixelMask& mask, double sigmas,
                   Points* points) {
  const double num_marked = static_cast<double>(std::count(mask.begin(), mask.end(), 1));
  const int stride = std::max(1, static_cast<int>(std::sqrt(num_marked / kStatisticsPixels)));
  std::vector<float> means;
  for (int v = 0; v < image.height; v += stride) {
    for (int u = 0; u < image.width; u += stride) {
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
  const float limit = OutlierLimit(image, mask, config.outlier_sigmas(), &points);
  PixelMask kept(mask.size());
  std::vector<int> num_near;
  for (int v = 0; v < image.height; ++v) {
    int first = 0;
    int last = image.width - 1;
    while (first <= last && !points.Has(first, v)) ++first;
    while (first <= last && !points.Has(last, v)) --last;
    if (first > last) continue;
    points.CountNear(v, first, last, limit, &num_near);
    for (int u = first; u <= last; ++u) {
      if (!points.Has(u, v)) continue;
      const bool surely_near = num_near[static_cast<size_t>(u)] >= config.outlier_neighbors();
      kept[image.Index(u, v)] = surely_near || !points.IsOutlier(u, v, limit);
    }
  }
  return kept;
}

}  // namespace declutter
