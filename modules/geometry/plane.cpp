#include "modules/geometry/plane.h"

namespace declutter {

Eigen::Isometry3d TableFrame(const Plane& plane_C) {
  const Eigen::Vector3d z = plane_C.normal.normalized();
  Eigen::Vector3d x = Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitX().dot(z) * z;
  // A camera whose x axis is the plane normal (rolled by 90 degrees): y takes its place.
  if (x.squaredNorm() < 1e-6) x = Eigen::Vector3d::UnitY() - Eigen::Vector3d::UnitY().dot(z) * z;
  x.normalize();
  Eigen::Matrix3d R_CT;
  R_CT << x, z.cross(x), z;
  Eigen::Isometry3d X_CT = Eigen::Isometry3d::Identity();
  X_CT.linear() = R_CT;
  X_CT.translation() = -plane_C.d * z;
  return X_CT.inverse();
}

}  // namespace declutter
