#pragma once

#include <cstddef>
#include <cstdint>

// Loops over pixels by SIMD, dispatched at run time to what the processor has. Results are the same
// bits with every instruction set: products and sums are neither fused nor reordered.
namespace declutter {

// Elements that CountPlaneInliers and CountNear may read, and write, after the last one.
inline constexpr size_t kKernelPadding = 16;

// Number of measured pixels, given by their rays (x, y, 1) and 1 / z, whose 1 / z is within band of
// a x + b y + c; 0 instead when it cannot exceed max_uncounted. values[num .. num + kKernelPadding)
// must be 0.
int CountPlaneInliers(const float* x, const float* y, const float* values, size_t num, float a,
                      float b, float c, float band, int max_uncounted);

// Per pixel of a row: 1 where it is measured and 1 / z is within band of a x + row.
void MarkPlaneInliers(const float* x, const float* values, size_t num, float a, float row,
                      float band, uint8_t* marked);

// Per pixel of a row but the first and the last: 1 where it is marked, as are at least min_marked
// pixels of itself and its 8 neighbours. Marks are 1.
void MarkAmid(const uint8_t* above, const uint8_t* middle, const uint8_t* below, size_t num,
              int min_marked, uint8_t* marked);

// Heights from which a pixel belongs to a foot and to an object, and below which to anything: as
// differences of 1 / z from the plane, and as slopes, heights over the camera's.
struct HeightLimits {
  float foot_residual = 0;    // [1/m]
  float object_residual = 0;  // [1/m]
  float foot_slope = 0;
  float object_slope = 0;
  float max_slope = 0;
};

// Per pixel of a row: 0 is not above the plane a x + row, 1 as high as a foot, 2 as high as an
// object.
void ClassifyHeights(const float* x, const float* values, size_t num, float a, float row,
                     const HeightLimits& limits, uint8_t* classes);

// A convex region of a plane: edges with inward normal (x, y) and offset, in coordinates of the
// plane given by its axes in the camera frame.
struct RegionView {
  const float* x_axis = nullptr;  // 3 elements
  const float* y_axis = nullptr;  // 3 elements
  const float* edges = nullptr;   // 3 elements each
  size_t num_edges = 0;
};

// Per pixel of a row: 1 where it is marked and its point on ray (x, y, 1) is over the region.
void MarkContained(const float* x, float y, const float* values, const uint8_t* marked, size_t num,
                   const RegionView& region, uint8_t* contained);

// The points of a row of an image, 0 where there is none, with the rows around it: rows -half ..
// half can be read, as can columns -half .. num + half + kKernelPadding.
struct PointWindow {
  const float* values = nullptr;  // [1/m] of the middle row's first column
  ptrdiff_t stride = 0;           // elements from one row to the next
  const float* x = nullptr;       // of the first column
  const float* y = nullptr;       // of the middle row
};

// Per point of a row: the number of other points in a window within `limit`, a distance over the
// depth of the point, or `enough` when there are more: the window of half width `half` is looked at
// only where that of half width 2 has fewer.
void CountNear(const PointWindow& window, size_t num, int half, float limit, int enough,
               int32_t* counts);

// Mean distance from column u of the middle row to its num_nearest nearest points in the window of
// half width `half`, at most 7, over its depth. Where there are fewer, the missing ones count as
// far as the farthest that there is; a point alone is infinitely far. guess, a little less than
// the distance of the farthest of the nearest over the depth, only makes it faster.
float MeanOfNearest(const PointWindow& window, size_t u, int half, size_t num_nearest, float guess);

}  // namespace declutter
