#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "modules/geometry/solid.h"

namespace declutter {

// What is seen on both sides of an obstacle may be one solid.

// The box with one end along x or y of O moved outward to the far end of points (points_O, in its
// frame) that lie in its prolongation. Nothing when they lie elsewhere, or on both sides.
std::optional<Solid> ProlongedOver(const std::vector<Eigen::Vector3d>& points_O, const Solid& box);

// The cylinder from the far end of one to that of another; nothing when their axes or radii differ.
std::optional<Solid> CylinderThrough(const Solid& a, const Solid& b);

}  // namespace declutter
