#include "modules/model_verifier/surface_fit.h"

#include <algorithm>
#include <cmath>

namespace declutter {

bool IsOn(const SurfacePoint& point, const BoxFace& face, const Eigen::Vector3d& half) {
  const double distance = face.sign * point.p_O[face.axis] - half[face.axis];
  if (std::abs(distance) > std::max(0.005, 3 * point.sigma)) return false;
  if (face.sign * point.ray_O[face.axis] > -0.05) return false;  // seen from behind or edge-on
  return point.n_O.isZero() || face.sign * point.n_O[face.axis] > kMinFitCos;
}

double Weight(const SurfacePoint& point, double cosine) {
  const double sigma = point.sigma * std::max(std::abs(cosine), 0.5);
  return 1 / (sigma * sigma);
}

}  // namespace declutter
