#pragma once

#include <Eigen/Core>
#include <vector>

#include "modules/geometry/solid.h"

namespace declutter {

// [m] rms of the mean distances of points from the side of a solid, strip by upright strip: noise
// averages out in them, what is left tells a flat side from a round one. Of a box, the side with
// the most points. 0 where too few points lie on it. points_O are measured points on the surface in
// its frame.
double SystematicMisfit(const Solid& solid, const std::vector<Eigen::Vector3d>& points_O);

}  // namespace declutter
