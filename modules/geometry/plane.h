#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace declutter {

// The plane normal . x + d = 0 in camera frame C, normal toward the camera: d > 0 is the height of
// the camera above it [m].
struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double d = 0;

  // [m] signed height of p_C above the plane.
  double Height(const Eigen::Vector3d& p_C) const { return normal.dot(p_C) + d; }
};

// Pose X_TC of C in the table frame T of a plane: z = plane normal, origin = camera centre
// projected onto the plane, x = camera x projected onto the plane. The xy plane of T is where lines
// and circles are fitted.
Eigen::Isometry3d TableFrame(const Plane& plane_C);

}  // namespace declutter
