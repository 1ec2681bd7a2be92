#pragma once

#include <Eigen/Core>
#include <vector>

#include "modules/geometry/depth_image.h"
#include "modules/geometry/solid.h"
#include "modules/model_verifier/end_evidence.h"
#include "modules/model_verifier/ray_casting.h"

namespace declutter {

// Covariance of a solid from what its ends rest on and, for a cylinder, from the points on its side
// (points_O, in its frame: the inverse of the normal matrix of the last fit). Every end has an
// error of its own; a position has that of the depth in common, which no extent has. The standard
// deviations are those of rendered scenes; noise_level is that of the sensor, as NoiseLevel tells.
SolidCovariance CovarianceOf(const Solid& solid, const SolidEnds& ends, const RayEvidence& evidence,
                             const std::vector<Eigen::Vector3d>& points_O,
                             const PinholeCamera& camera, double noise_level);

}  // namespace declutter
