#pragma once

#include <cstddef>
#include <cstdint>

// Loops over the pixels of a grid by SIMD, dispatched at run time to what the processor has.
// Results are the same bits with every instruction set: products and sums are neither fused nor
// reordered, and what is summed over pixels is summed in integers.
namespace declutter {

// Pixels behind a row that can be read, and elements behind the last one that can be written.
inline constexpr size_t kRayPadding = 16;

// 1 as a fit in fixed point.
inline constexpr int32_t kFitUnit = 1 << 16;

// A solid as rays from the camera meet it.
struct RaySolid {
  bool is_cylinder = false;
  float half_size[3] = {};  // [m] along x, y, z of O
  float camera_O[3] = {};   // [m] the camera in O
  float R_OC[9] = {};       // row-major
  float support[4] = {};    // normal in C of the support plane and the camera's height above it
};

// Pixels u_begin .. u_end of rows v_begin .. v_end of a grid.
struct RayWindow {
  const float* ray_x = nullptr;     // per column
  const float* ray_y = nullptr;     // per row
  const float* z = nullptr;         // [m] per pixel, 0: not measured
  size_t stride = 0;                // elements of z from one row to the next
  const float* normal_x = nullptr;  // in C, zero: not known
  const float* normal_y = nullptr;
  const float* normal_z = nullptr;
  size_t normal_stride = 0;
  int normal_shift = 0;  // 0 or 1: the normal of pixel (u, v) is that of (u >> shift, v >> shift)
  int columns = 0;       // pixel (u, v) has index v * columns + u
  int u_begin = 0, u_end = 0, v_begin = 0, v_end = 0;
};

// What decides how a pixel was measured.
struct RayLimits {
  float min_tolerance_m = 0;           // a measurement on a surface is nearer to it than this,
  float tolerance_per_square = 0;      // [1/m] or than this times its squared depth
  float min_height_in_tolerances = 0;  // below it, a point is one of the support plane
  float edge_margin_m = 0;             // around the edges of a solid normals are blurred
  float max_overhang_m = 0;            // beside a solid that its top face is looked for
  float top_tolerance_m = 0;           // in height of points on one top face
  float min_normal_cos = 0;            // of a measured normal and the surface's
};

// How many pixels were measured in which way, and which on the surface.
struct RayCounts {
  int num_explained = 0, num_hollow = 0, num_contradicting = 0, num_occluded = 0, num_violating = 0,
      num_overhanging = 0, num_unknown = 0;
  int64_t fit = 0;               // sum over the explained ones, in kFitUnit
  int32_t* explained = nullptr;  // indices of pixels, in their order; room for all and kRayPadding
  int32_t* fits = nullptr;       // in kFitUnit, of each of them
  int32_t* hollow = nullptr;     // indices of pixels
  int32_t* overhanging = nullptr;  // the same
};

// Sorts the pixels of a window into what they say of a solid.
void CastWindow(const RaySolid& solid, const RayWindow& window, const RayLimits& limits,
                RayCounts* counts);

// Points of a solid A: element i is origin + axes * (x[i], y[i], z[i]), in O of another. Arrays
// have kRayPadding elements behind the last one.
struct SamplePoints {
  const float* x = nullptr;
  const float* y = nullptr;
  const float* z = nullptr;
  size_t num = 0;
  float axes[9] = {};  // row-major
  float origin[3] = {};
};

// How many of the points lie deeper inside a solid than min_depth_m.
int CountInside(const RaySolid& solid, const SamplePoints& points, float min_depth_m);

// Number of pixels above the support plane by more than min_height_in_tolerances and nearer to a
// solid than reach_m.
int CountNear(const RaySolid& solid, const RayWindow& window, const RayLimits& limits,
              float reach_m);

}  // namespace declutter
