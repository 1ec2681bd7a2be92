#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "modules/geometry/depth_image.h"
#include "modules/geometry/uninitialized.h"

namespace declutter {

// The pixels of a depth image that are multiples of `step` in both directions, as planes of floats
// for SIMD: row-major, each row with at least kPadding elements more than it has pixels.
struct PixelGrid {
  static constexpr size_t kPadding = 16;

  int step = 1;
  int columns = 0;
  int rows = 0;
  size_t stride = 0;         // elements from one row to the next
  std::vector<float> ray_x;  // x of the ray with z = 1, per column
  std::vector<float> ray_y;  // y of it, per row
  // [m] depth, 0: not measured.
  UninitializedVector<float> z;

  // Makes this the grid of an image; the planes are used again.
  void Set(const DepthImage& image, int step);

  int num_pixels() const { return columns * rows; }
  // Of pixel row * columns + column in z.
  size_t Index(int32_t pixel) const {
    return static_cast<size_t>(pixel / columns) * stride + static_cast<size_t>(pixel % columns);
  }
  // [px] of the image that each of these pixels stands for.
  int pixel_weight() const { return step * step; }
};

}  // namespace declutter
