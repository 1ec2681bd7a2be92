#pragma once

#include <Eigen/Core>
#include <vector>

#include "modules/geometry/solid.h"
#include "modules/model_verifier/ray_casting.h"

namespace declutter {

// A measurement near a solid, in its frame O.
struct SurfacePoint {
  Eigen::Vector3d p_O;    // [m]
  Eigen::Vector3d n_O;    // measured unit normal, zero: unknown
  Eigen::Vector3d ray_O;  // unit direction from the camera to the point
  double sigma;           // [m] standard deviation along the ray
  int num_px;             // pixels of the sensor that it stands for
  double pixel_area;      // [m^2] of these pixels, at right angles to the ray
};

// Observed points within margin_m of the solid.
std::vector<SurfacePoint> PointsNear(const Solid& solid, double margin_m,
                                     const Observation& observation);

}  // namespace declutter
