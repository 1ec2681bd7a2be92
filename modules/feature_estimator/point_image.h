#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "modules/geometry/tabletop.h"

namespace declutter {

// Positions in C of the object pixels of a tabletop, on the smallest grid that holds them all,
// thinned pixels closed up, surrounded by a margin that no window around a pixel leaves.
struct PointImage {
  // Coordinate of pixels without a point: no point of a scene is near it.
  static constexpr float kFar = 1e6F;
  // Points processed side by side; rows can be read that far beyond the grid.
  static constexpr int kLanes = 8;

  int width = 0;               // [px] of the grid
  int height = 0;              // [px]
  int thinning = 1;            // image pixels from one grid pixel to the next
  int first_u = 0;             // [px] image column of the grid's first column
  int first_v = 0;             // [px] image row of the grid's first row
  float fx = 0;                // [px] of the grid
  float fy = 0;                // [px]
  int margin = 0;              // [px] at all sides
  int stride = 0;              // elements from one row to the next
  std::vector<float> x, y, z;  // [m] kFar where there is no point

  bool empty() const { return width == 0; }
  // Element of grid pixel (i, j), 0 <= i < width, 0 <= j < height.
  size_t Index(int i, int j) const {
    return static_cast<size_t>(j + margin) * static_cast<size_t>(stride) +
           static_cast<size_t>(i + margin);
  }
  bool HasPoint(size_t index) const { return x[index] < kFar; }
};

// The points of all object pixels; windows of radius max_radius_m stay inside the margin, which is
// at least min_margin_px wide. Here and below `recycled` gives its memory to the result.
PointImage MakePointImage(const Tabletop& tabletop, double max_radius_m, int min_margin_px = 1,
                          PointImage recycled = {});

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
  SphereWindow(const PointImage& points, size_t begin, const Neighborhood& neighborhood)
      : SphereWindow(points, points.x.data(), begin, neighborhood) {}
  // Around those of them that have an x below kFar.
  SphereWindow(const PointImage& points, const float* x, size_t begin,
               const Neighborhood& neighborhood);

  int stride() const { return stride_; }
  int num_rows() const { return num_rows_; }
  int Columns(int row) const {
    const float y = static_cast<float>(row) * inverse_fy_;
    const float columns = fx_ * std::sqrt(std::max(slope_ * slope_ - y * y, 0.0F));
    return std::min(static_cast<int>(columns), margin_) / stride_ * stride_;
  }

 private:
  float slope_ = 0;  // half width of the window at z = 1
  float fx_ = 0;
  float inverse_fy_ = 0;
  int margin_ = 0;
  int num_rows_ = 0;
  int stride_ = 1;
};

}  // namespace declutter
