#pragma once

#include <cstddef>
#include <cstdint>

#include "modules/model_verifier/ray_kernels.h"

// Loops over the pixels of a grid, and over the points found in it, by SIMD, dispatched at run time
// to what the processor has. Results are the same bits with every instruction set.
namespace declutter {

// Measurements on surfaces of a solid, in its frame O: element i of each array is of point i.
// Arrays have kRayPadding elements behind the last one.
struct FitArrays {
  float* p[3] = {};             // [m]
  float* n[3] = {};             // measured unit normal, zero: unknown
  float* ray[3] = {};           // unit direction from the camera to the point
  float* sigma = nullptr;       // [m] standard deviation along the ray
  int32_t* surfaces = nullptr;  // bits, see SurfaceBit
  size_t num = 0;
};

// The bit of the face at the side `sign` of an axis of O. The side of a cylinder has that of axis
// 0.
constexpr int32_t SurfaceBit(int axis, int sign) { return 1 << (2 * axis + (sign > 0)); }
inline constexpr int32_t kCylinderSideBit = SurfaceBit(0, 1);

// What a point on a surface is.
struct FitLimits {
  float margin_m = 0;             // around the solid that points are looked for
  float sigma_per_square = 0;     // [1/m] of a measurement, over its squared depth
  float min_tolerance_m = 0;      // a point is nearer to its surface than this,
  float tolerance_in_sigmas = 0;  // or than so many standard deviations
  float min_incidence_cos = 0;    // of the ray to a surface: it is not seen edge-on
  float min_normal_cos = 0;       // of a measured normal and the surface's
  float end_margin_m = 0;         // of the side of a cylinder, at its ends
};

// Fills in the points of a window that lie on a surface of the solid, except its lower end: a face
// of a box, the top of a cylinder, or, whatever their distance from the axis, between the ends of
// one. The arrays have room for all pixels of the window.
void FindFitPoints(const RaySolid& solid, const RayWindow& window, const FitLimits& limits,
                   FitArrays* points);

}  // namespace declutter
