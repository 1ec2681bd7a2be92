#pragma once

#include <cstddef>
#include <utility>
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
  // [px] half a window at most: closer to the camera, windows are smaller than they should be.
  static constexpr int kMaxWindow = 65;

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
  std::vector<float> ray_x;    // of each column: x / z

  bool empty() const { return width == 0; }
  // Element of grid pixel (i, j), 0 <= i < width, 0 <= j < height.
  size_t Index(int i, int j) const {
    return static_cast<size_t>(j + margin) * static_cast<size_t>(stride) +
           static_cast<size_t>(i + margin);
  }
  // Image column and row [px] of an element of the grid.
  std::pair<int, int> PixelOf(size_t index) const {
    const int i = static_cast<int>(index) % stride - margin;
    const int j = static_cast<int>(index) / stride - margin;
    return {first_u + i * thinning, first_v + j * thinning};
  }
  bool HasPoint(size_t index) const { return x[index] < kFar; }
};

// The points of all object pixels; windows of radius max_radius_m stay inside the margin, which is
// at least min_margin_px wide. Here and below `recycled` gives its memory to the result.
PointImage MakePointImage(const Tabletop& tabletop, double max_radius_m, int min_margin_px = 1,
                          PointImage recycled = {});

}  // namespace declutter
