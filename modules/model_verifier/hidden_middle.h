#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "modules/geometry/solid.h"

namespace declutter {

// The solid with one end moved outward to the far end of points (points_O, in its frame) that lie
// in its prolongation: what is seen on both sides of an obstacle may be one. Boxes grow along x or
// y of O, cylinders along their axis. Nothing when the points lie elsewhere, or on both sides.
std::optional<Solid> ProlongedOver(const std::vector<Eigen::Vector3d>& points_O, Solid solid);

}  // namespace declutter
