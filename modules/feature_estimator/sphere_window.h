#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "modules/feature_estimator/lanes.h"
#include "modules/feature_estimator/point_image.h"

namespace declutter {

// Points within a metric radius.
struct Neighborhood {
  static constexpr int kReadAll = 1000;

  double radius_m = 0;
  // Image windows up to this half width are read pixel by pixel, wider ones at a stride:
  // neighbouring pixels of a sensor share most of their noise.
  int dense_px = kReadAll;
};

// The image window of all neighbours of a few adjacent points: every stride-th row of -num_rows ..
// num_rows, in each of them every stride-th column of -Columns(row) .. Columns(row).
class SphereWindow {
 public:
  // Around the points in elements [begin, begin + PointImage::kLanes) of one row.
  DECLUTTER_LANES SphereWindow(const PointImage& points, size_t begin,
                               const Neighborhood& neighborhood)
      : SphereWindow(points, points.x.data(), begin, neighborhood) {}
  // Around those of them that have an x below kFar.
  DECLUTTER_LANES SphereWindow(const PointImage& points, const float* x, size_t begin,
                               const Neighborhood& neighborhood)
      : fx_(points.fx),
        inverse_fy_(1 / points.fy),
        max_columns_(static_cast<float>(points.margin)) {
    const float slope = MaxSlope(points, x, begin, static_cast<float>(neighborhood.radius_m));
    squared_slope_ = slope * slope;
    num_rows_ = std::min(static_cast<int>(slope * points.fy), points.margin);
    stride_ = 1 + num_rows_ / (neighborhood.dense_px + 1);
    num_rows_ = num_rows_ / stride_ * stride_;
    inverse_stride_ = 1 / static_cast<float>(stride_);
  }

  // Half of its width at z = 1.
  DECLUTTER_LANES float slope() const { return std::sqrt(squared_slope_); }
  DECLUTTER_LANES int stride() const { return stride_; }
  DECLUTTER_LANES int num_rows() const { return num_rows_; }
  DECLUTTER_LANES int Columns(int row) const {
    const float y = static_cast<float>(row) * inverse_fy_;
    const float columns = fx_ * std::sqrt(std::max(squared_slope_ - y * y, 0.0F));
    return static_cast<int>(std::min(columns, max_columns_) * inverse_stride_) * stride_;
  }

 private:
  // A neighbour at P + e, |e| <= r, is seen |e_xy - (P_xy / z) e_z| / (z + e_z) away from P at
  // z = 1, at most r sqrt(1 + |P_xy|^2 / z^2) / (z - r). This is the largest such value.
  DECLUTTER_LANES static float MaxSlope(const PointImage& points, const float* x, size_t begin,
                                        float radius_m) {
    Lanes px, py, pz, known_x;
    LoadLanes(&points.x[begin], px);
    LoadLanes(&points.y[begin], py);
    LoadLanes(&points.z[begin], pz);
    LoadLanes(&x[begin], known_x);
    const Lanes least = 1e-3F + Lanes{};
    Lanes room = pz - radius_m;
    room = pz * (room > least ? room : least);
    Lanes square = (px * px + py * py + pz * pz) / (room * room);
    KeepLanes(known_x < PointImage::kFar, square);
    float squares[PointImage::kLanes];
    StoreLanes(square, squares);
    return radius_m * std::sqrt(*std::max_element(squares, squares + PointImage::kLanes));
  }

  float squared_slope_ = 0;  // half width of the window at z = 1
  float fx_ = 0;
  float inverse_fy_ = 0;
  float max_columns_ = 0;
  float inverse_stride_ = 1;
  int num_rows_ = 0;
  int stride_ = 1;
};

// The part of a window in which neighbours may be nearer than a distance.
class SphereCore {
 public:
  DECLUTTER_LANES SphereCore(const PointImage& points, size_t begin, float distance_m,
                             const SphereWindow& window)
      : fx_(points.fx), inverse_fy_(1 / points.fy) {
    const float slope = Slope(points, begin, distance_m, window);
    squared_slope_ = slope * slope;
  }

  // -1: none in this row.
  DECLUTTER_LANES int Columns(int row) const {
    const float y = static_cast<float>(row) * inverse_fy_;
    const float square = squared_slope_ - y * y;
    return square < 0 ? -1 : static_cast<int>(fx_ * std::sqrt(square));
  }

 private:
  static constexpr float kRounding = 1.001F;

  // With rays a = P / z and b = a + e of two pixels, no point on b is nearer to P than
  // z |a x b| / |b|, which is at least z |e| / |b|. This is the largest |e| with which one may be
  // nearer than the distance.
  DECLUTTER_LANES static float Slope(const PointImage& points, size_t begin, float distance_m,
                                     const SphereWindow& window) {
    float slope = 0;
    for (size_t lane = 0; lane < PointImage::kLanes; ++lane) {
      if (!points.HasPoint(begin + lane)) continue;
      const float z = points.z[begin + lane];
      const float x = points.x[begin + lane] / z, y = points.y[begin + lane] / z;
      const float reach = std::sqrt(x * x + y * y) + window.slope();
      slope = std::max(slope, kRounding * distance_m / z * std::sqrt(1 + reach * reach));
    }
    return slope;
  }

  float squared_slope_ = 0;
  float fx_ = 0;
  float inverse_fy_ = 0;
};

}  // namespace declutter
