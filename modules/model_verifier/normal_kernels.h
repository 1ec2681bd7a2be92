#pragma once

#include <cstddef>

// Loops over pixels for normals by SIMD, dispatched at run time to what the processor has. Results
// are the same bits with every instruction set: products and sums are neither fused nor reordered.
namespace declutter {

// Elements behind the last pixel of a row, and around the image of means, that can be read.
inline constexpr int kNormalMargin_px = 16;

// Per pixel of a row, except the first and the last: mean inverse depth [1/m] of the 3 x 3 pixels
// around it whose inverse depth is within max_jump of its own; 0: not measured. Rows are of inverse
// depth, 0: not measured.
void MeanInverseDepths(const float* above, const float* middle, const float* below, size_t num,
                       float max_jump, float* means);

// What the normals of a row are computed from.
struct NormalRow {
  const float* ray_x = nullptr;  // of each pixel
  float ray_y = 0;
  const float* z = nullptr;      // [m] of each pixel, 0: not measured
  const float* means = nullptr;  // of the first pixel in the image of means
  ptrdiff_t means_stride = 0;    // elements from one row of it to the next
  int step = 1;                  // pixels of the image of means from one pixel to the next
  size_t num = 0;
};

// How far the gradient of inverse depth reaches, and what it tolerates.
struct GradientLimits {
  float fx = 0;       // [px]
  float fy = 0;       // [px]
  float reach_m = 0;  // from a pixel to those its gradient is taken from
  float min_reach_px = 0;
  float max_reach_px = 0;  // at most kNormalMargin_px
  float max_jump = 0;      // [1/m] of inverse depth on one surface
};

// Unit normals toward the camera; zero where the surface is not smooth or not measured.
void NormalsOfRow(const NormalRow& row, const GradientLimits& limits, float* x, float* y, float* z);

}  // namespace declutter
