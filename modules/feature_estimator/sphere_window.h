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

// Half widths [px] of a disc in rows at a distance from its centre, found before they are needed:
// so the loops over pixels need not wait for roots.
class DiscRows {
 public:
  // Of the rows 0, stride, 2 * stride, .. num_rows, in multiples of the stride; -stride beyond the
  // disc, whose radius is squared_slope at z = 1.
  DECLUTTER_LANES void Fill(float squared_slope, float fx, float inverse_fy, int max_columns,
                            int stride, int num_rows) {
    const float inverse_stride = 1 / static_cast<float>(stride);
    for (int row = 0, step = 0; row <= num_rows; row += stride, ++step) {
      const float y = static_cast<float>(row) * inverse_fy;
      const float square = squared_slope - y * y;
      const float columns = fx * std::sqrt(std::max(square, 0.0F));
      columns_[step] =
          square < 0
              ? -stride
              : stride * static_cast<int>(std::min(columns, static_cast<float>(max_columns)) *
                                          inverse_stride);
    }
  }
  // In row step * stride and -step * stride.
  DECLUTTER_LANES int Columns(int step) const { return columns_[step < 0 ? -step : step]; }

 private:
  int columns_[PointImage::kMaxWindow + 1];
};

// The image window of all neighbours of a few adjacent points: rows stride() * -num_steps() ..
// num_steps(), in each of them every stride-th column of -Columns(step) .. Columns(step).
class SphereWindow {
 public:
  // Around the points in elements [begin, begin + PointImage::kLanes) of one row.
  DECLUTTER_LANES SphereWindow(const PointImage& points, size_t begin,
                               const Neighborhood& neighborhood)
      : SphereWindow(points, points.x.data(), begin, neighborhood) {}
  // Around those of them that have an x below kFar.
  DECLUTTER_LANES SphereWindow(const PointImage& points, const float* x, size_t begin,
                               const Neighborhood& neighborhood) {
    const float slope = MaxSlope(points, x, begin, static_cast<float>(neighborhood.radius_m));
    slope_ = slope;
    const int max_rows = std::min(points.margin, PointImage::kMaxWindow);
    const int num_rows = std::min(static_cast<int>(slope * points.fy), max_rows);
    stride_ = 1 + num_rows / (neighborhood.dense_px + 1);
    num_steps_ = num_rows / stride_;
    rows_.Fill(slope * slope, points.fx, 1 / points.fy, max_rows, stride_, num_steps_ * stride_);
  }

  // Half of its width at z = 1.
  DECLUTTER_LANES float slope() const { return slope_; }
  DECLUTTER_LANES int stride() const { return stride_; }
  DECLUTTER_LANES int num_steps() const { return num_steps_; }
  DECLUTTER_LANES int Columns(int step) const { return rows_.Columns(step); }

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

  float slope_ = 0;
  int stride_ = 1;
  int num_steps_ = 0;
  DiscRows rows_;
};

// The part of a window in which neighbours may be nearer than a distance.
class SphereCore {
 public:
  DECLUTTER_LANES SphereCore(const PointImage& points, size_t begin, float distance_m,
                             const SphereWindow& window) {
    const float slope = Slope(points, begin, distance_m, window);
    rows_.Fill(slope * slope, points.fx, 1 / points.fy, PointImage::kMaxWindow, 1,
               window.num_steps());
  }

  // Of a window with stride 1; -1: none in this row.
  DECLUTTER_LANES int Columns(int row) const { return rows_.Columns(row); }

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

  DiscRows rows_;
};

}  // namespace declutter
