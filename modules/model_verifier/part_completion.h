#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "modules/geometry/solid.h"
#include "modules/model_verifier/surface_parts.h"

namespace declutter {

// Standing solids in C whose surface a part may be: a box along its outline, and a cylinder through
// it. X_CT is the pose of T in C.
std::vector<Hypothesis> SolidsOver(const SurfacePart& part, const Eigen::Isometry3d& X_CT);

}  // namespace declutter
