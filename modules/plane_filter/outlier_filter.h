#pragma once

#include <cstdint>
#include <vector>

#include "modules/plane_filter/inverse_depth.h"
#include "modules/plane_filter/pixel_kernels.h"
#include "modules/plane_filter/plane_filter.pb.h"

namespace declutter {

// Removes statistical outliers (paper, section 3, step ii): a pixel's mean distance to its nearest
// marked neighbours in an image window, over its depth, must not exceed the average of all marked
// pixels by more than outlier_sigmas standard deviations.
class OutlierFilter {
 public:
  explicit OutlierFilter(const PlaneFilterConfig& config);

  // The marked pixels that are no outliers. Valid until the next call, which uses all memory again.
  const PixelMask& Filter(const InverseDepth& image, const PixelMask& mask);

 private:
  void CopyMarked(const InverseDepth& image, const PixelMask& mask);
  float MaxMeanDistance(const InverseDepth& image, const PixelMask& mask);
  PointWindow Row(int v) const;
  float MeanOfNearest(size_t u, int v, float guess) const;

  int half_width_;  // [px] of the window
  size_t num_nearest_;
  double sigmas_;
  int margin_;  // [px] around the image, which no window leaves

  // The marked points of the image, with the margin around them.
  int stride_ = 0;
  std::vector<float> x_, y_, values_;

  std::vector<float> means_;
  std::vector<int32_t> num_near_;  // of the points of a row
  std::vector<uint8_t> doubtful_;  // points of a row
  PixelMask kept_;
};

}  // namespace declutter
