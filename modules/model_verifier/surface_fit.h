#pragma once

#include <Eigen/Core>

#include "modules/model_verifier/surface_points.h"

namespace declutter {

// What fits of boxes and of cylinders to surface points have in common.
inline constexpr double kFitMargin = 0.030;  // [m] around a solid where its points are looked for
inline constexpr double kFitEdgeMargin =
    0.008;                                  // [m] along edges where surfaces are rounded or blurred
inline constexpr double kMinFitCos = 0.80;  // of a measured normal and the surface's
inline constexpr int kMinFitPoints = 60;    // [px] that move a face

// A face of a box: the side `sign` of an axis of O.
struct BoxFace {
  int axis;
  int sign;
};

// True for a point on a face of a solid with these half extents, but for where the face ends.
bool IsOn(const SurfacePoint& point, const BoxFace& face, const Eigen::Vector3d& half);

// 1 / variance of the distance to a surface with this normal. Half the sensor's noise does not
// average out at grazing rays, which bounds the weight.
double Weight(const SurfacePoint& point, double cosine);

}  // namespace declutter
