#pragma once

#include <cstddef>
#include <cstdint>

#include "modules/model_verifier/ray_kernels.h"

// Loops over the pixels of a grid by SIMD, dispatched at run time to what the processor has.
// Results are the same bits with every instruction set.
namespace declutter {

// A measurement on a surface of a solid, in its frame O.
struct FitPoint {
  float p_O[3];       // [m]
  float n_O[3];       // measured unit normal, zero: unknown
  float ray_O[3];     // unit direction from the camera to the point
  float sigma;        // [m] standard deviation along the ray
  float pixel_area;   // [m^2] of the pixels that it stands for, at right angles to the ray
  uint32_t surfaces;  // bits, see SurfaceBit
};

// The bit of the face at the side `sign` of an axis of O. The side of a cylinder has that of axis
// 0.
constexpr uint32_t SurfaceBit(int axis, int sign) { return 1u << (2 * axis + (sign > 0)); }
inline constexpr uint32_t kCylinderSideBit = SurfaceBit(0, 1);

// What a point on a surface is.
struct FitLimits {
  float margin_m = 0;             // around the solid that points are looked for
  float sigma_per_square = 0;     // [1/m] of a measurement, over its squared depth
  float min_tolerance_m = 0;      // a point is nearer to its surface than this,
  float tolerance_in_sigmas = 0;  // or than so many standard deviations
  float min_incidence_cos = 0;    // of the ray to a surface: it is not seen edge-on
  float min_normal_cos = 0;       // of a measured normal and the surface's
  float end_margin_m = 0;         // of the side of a cylinder, at its ends
  float area_per_square = 0;      // [1] of a pixel, over its squared depth
};

// Appends the points of a window that lie on a surface of the solid, except its lower end: a face
// of a box, the top of a cylinder, or, whatever their distance from the axis, between the ends of
// one. Returns how many; `points` has room for all pixels of the window.
size_t FindFitPoints(const RaySolid& solid, const RayWindow& window, const FitLimits& limits,
                     FitPoint* points);

}  // namespace declutter
