#include "modules/plane_filter/outlier_filter.h"

#include <algorithm>
#include <cmath>

namespace declutter {
namespace {

// Distances of a pixel's point to the marked points in a window, over its depth.
class WindowDistances {
 public:
  WindowDistances(const InverseDepth& image, const PixelMask& mask, const PlaneFilterConfig& config)
      : image_(image),
        mask_(mask),
        half_width_(config.outlier_window_px() / 2),
        num_nearest_(config.outlier_neighbors()) {}

  // Mean over the nearest neighbours; where the window has fewer, the missing ones count as far as
  // the farthest one there is, and a pixel alone is infinitely far.
  float MeanOfNearest(int u, int v) {
    distances_.clear();
    const float value = image_.values[image_.Index(u, v)];
    for (int dv = std::max(-half_width_, -v); dv <= half_width_ && v + dv < image_.height; ++dv) {
      for (int du = std::max(-half_width_, -u); du <= half_width_ && u + du < image_.width; ++du) {
        const size_t j = image_.Index(u + du, v + dv);
        if (!mask_[j] || (du == 0 && dv == 0)) continue;
        distances_.push_back(SquaredDistance(u, v, value, u + du, v + dv, image_.values[j]));
      }
    }
    return MeanOfNearestRoots();
  }

 private:
  // Over the squared depth of the first point.
  float SquaredDistance(int u, int v, float value, int other_u, int other_v,
                        float other_value) const {
    const float ratio = value / other_value;
    const float dx =
        image_.ray_x[static_cast<size_t>(other_u)] * ratio - image_.ray_x[static_cast<size_t>(u)];
    const float dy =
        image_.ray_y[static_cast<size_t>(other_v)] * ratio - image_.ray_y[static_cast<size_t>(v)];
    return dx * dx + dy * dy + (ratio - 1) * (ratio - 1);
  }

  float MeanOfNearestRoots() {
    if (distances_.empty()) return HUGE_VALF;
    const size_t num_nearest = static_cast<size_t>(num_nearest_);
    if (distances_.size() > num_nearest) {
      std::nth_element(distances_.begin(), distances_.begin() + num_nearest_ - 1, distances_.end());
      distances_.resize(num_nearest);
    }
    float sum = 0;
    float farthest = 0;
    for (const float squared : distances_) {
      sum += std::sqrt(squared);
      farthest = std::max(farthest, squared);
    }
    sum += std::sqrt(farthest) * static_cast<float>(num_nearest - distances_.size());
    return sum / static_cast<float>(num_nearest);
  }

  const InverseDepth& image_;
  const PixelMask& mask_;
  int half_width_;
  int num_nearest_;
  std::vector<float> distances_;
};

}  // namespace

PixelMask RemoveOutliers(const InverseDepth& image, const PixelMask& mask,
                         const PlaneFilterConfig& config) {
  WindowDistances window(image, mask, config);
  std::vector<float> means(mask.size());
  double sum = 0;
  double sum_squares = 0;
  double count = 0;
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      const size_t i = image.Index(u, v);
      if (!mask[i]) continue;
      means[i] = window.MeanOfNearest(u, v);
      if (means[i] == HUGE_VALF) continue;
      sum += means[i];
      sum_squares += static_cast<double>(means[i]) * means[i];
      ++count;
    }
  }
  const double mean = sum / std::max(count, 1.0);
  const double variance = std::max(0.0, sum_squares / std::max(count, 1.0) - mean * mean);
  const float limit = static_cast<float>(mean + config.outlier_sigmas() * std::sqrt(variance));
  PixelMask kept(mask.size());
  for (size_t i = 0; i < mask.size(); ++i) kept[i] = mask[i] && means[i] <= limit;
  return kept;
}

}  // namespace declutter
