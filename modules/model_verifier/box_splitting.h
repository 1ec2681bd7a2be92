#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "modules/geometry/solid.h"

namespace declutter {

// The two boxes side by side that hold the points in the least area seen from above, when that is
// clearly less than one box does. points_O are measured points on the surface of the box, in its
// frame.
std::optional<std::array<Solid, 2>> SplitBox(const Solid& box,
                                             const std::vector<Eigen::Vector3d>& points_O);

}  // namespace declutter
