#pragma once

#include <Eigen/Core>
#include <vector>

#include "modules/geometry/solid.h"

namespace declutter {

// A short piece of the outline of a solid.
struct WireSegment {
  Eigen::Vector3d from_C;     // [m]
  Eigen::Vector3d to_C;       // [m]
  bool faces_camera = false;  // false: the solid itself hides it
};

// The twelve edges of a box, or the two circles of a cylinder and the two lines where its side
// turns away from the camera, which is at the origin of C.
std::vector<WireSegment> Wireframe(const Solid& solid);

}  // namespace declutter
