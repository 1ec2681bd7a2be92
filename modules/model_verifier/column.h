#pragma once

#include <Eigen/Core>
#include <vector>

#include "modules/geometry/solid.h"

// What tells two upright solids on each other from the parts of one.
namespace declutter {

// True when their outlines, seen from above, differ by no more than blurred edges.
bool HaveOneCrossSection(const Solid& a, const Solid& b);

// True for boxes when the sides of both that are turned toward the camera lie in the same planes.
// The side of a carton that bulges, or that a sensor bends, is of two boxes rather than of one by
// what is measured on it alone.
bool AreFlush(const Solid& a, const Solid& b);

// True when points lie on the upper end, inside its edges. points_O are those that a solid
// explains, each of which stands for pixel_weight [px].
bool IsTopSeen(const Solid& solid, const std::vector<Eigen::Vector3d>& points_O, int pixel_weight);

}  // namespace declutter
