#pragma once

#include "modules/geometry/plane.h"
#include "modules/geometry/solid.h"
#include "modules/model_verifier/observation.h"
#include "modules/model_verifier/ray_kernels.h"

namespace declutter {

// Pixel rectangle, end exclusive.
struct PixelWindow {
  int u_begin = 0, u_end = 0, v_begin = 0, v_end = 0;
};

// The part of the image that a solid with a margin around it projects to; the whole image when it
// reaches behind the camera.
PixelWindow ProjectionWindow(const Solid& solid, double margin_m, const PinholeCamera& camera);

// What kernels need of a solid, and of the part of an observation that it and a margin around it
// project to.
RaySolid AsRaySolid(const Solid& solid, const Plane& support);
RayWindow WindowOf(const Solid& solid, double margin_m, const Observation& observation);

}  // namespace declutter
