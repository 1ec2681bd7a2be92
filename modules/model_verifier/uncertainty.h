#pragma once

#include <Eigen/Core>
#include <vector>

#include "modules/geometry/depth_image.h"
#include "modules/geometry/solid.h"
#include "modules/model_verifier/end_evidence.h"

namespace declutter {

// Of the ends of a solid that explains num_explained pixels, by what they rest on. The standard
// deviations are those of rendered scenes; noise_level is that of the sensor, as ImageNoise tells.
EndVariances VariancesOf(const Solid& solid, const SolidEnds& ends, int num_explained,
                         const PinholeCamera& camera, double noise_level);

// Covariance of a box, as far as it is seen, from its ends. Every end has an error of its own; a
// position has that of the depth in common, which no extent has.
SolidCovariance CovarianceOfBox(const Solid& seen, const SolidEnds& ends,
                                const EndVariances& variances, const PinholeCamera& camera,
                                double noise_level);

// The same of a cylinder, from its ends along the axis and from the points on its side (points_O,
// in its frame, each of which stands for pixel_weight pixels): the inverse of the normal matrix of
// the last fit.
SolidCovariance CovarianceOfCylinder(const Solid& cylinder, const EndVariances& variances,
                                     const std::vector<Eigen::Vector3d>& points_O, int pixel_weight,
                                     double noise_level);

}  // namespace declutter
