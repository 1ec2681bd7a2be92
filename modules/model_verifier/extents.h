#pragma once

#include "modules/geometry/solid.h"

namespace declutter {

inline constexpr double kMinExtent = 0.015;  // [m] that can be grasped
inline constexpr double kMaxExtent = 0.40;   // [m]
inline constexpr double kEdgeBlur = 0.010;   // [m] by which what is measured around an edge is off

// The solid with the end `sign` (1 or -1) of an axis of O moved outward by growth [m].
inline Solid Longer(Solid solid, int axis, int sign, double growth) {
  solid.X_CO.translation() += 0.5 * sign * growth * solid.X_CO.linear().col(axis);
  solid.size[axis] += growth;
  return solid;
}

}  // namespace declutter
