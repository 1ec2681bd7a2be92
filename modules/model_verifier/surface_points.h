#pragma once

#include <Eigen/Core>
#include <vector>

#include "modules/geometry/depth_image.h"
#include "modules/geometry/solid.h"
#include "modules/model_verifier/normal_image.h"

namespace declutter {

// A measurement near a solid, in its frame O.
struct SurfacePoint {
  Eigen::Vector3d p_O;    // [m]
  Eigen::Vector3d n_O;    // measured unit normal, zero: unknown
  Eigen::Vector3d ray_O;  // unit direction from the camera to the point
  double sigma;           // [m] standard deviation along the ray
  double pixel_area;      // [m^2] that the pixel covers at right angles to the ray
};

// Points of the image within margin_m of the solid.
std::vector<SurfacePoint> PointsNear(const Solid& solid, double margin_m, const DepthImage& image,
                                     const NormalImage& normals);

}  // namespace declutter
