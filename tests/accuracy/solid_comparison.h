#pragma once

#include <Eigen/Core>
#include <array>

#include "modules/geometry/solid.h"

namespace declutter::accuracy {

// [rad] angle between the support normal up_C and the axis of a cylinder, or the nearest axis of a
// box: 0 when it stands.
double TiltOf(const Solid& solid, const Eigen::Vector3d& up_C);

// Share in [0, 1] of the volume of a that lies in b, by a grid of points in a.
double ShareInside(const Solid& a, const Solid& b);

// Intersection over union of the volumes.
double VolumeIou(const Solid& a, const Solid& b);

// A model beside the exact solid of the same shape.
struct SolidError {
  Eigen::Vector3d center_C;  // [m] model minus truth
  // [m] model minus truth: along the axes x, y, z of the true box; radius, radius, height.
  Eigen::Vector3d extent;
  std::array<int, 3> axis{0, 1, 2};  // axis of the model's box beside each axis of the true box
  double axis_rad = 0;               // between the axes of cylinders, the upright axes of boxes
  double yaw_rad = 0;                // between the x axes of boxes; 0 for cylinders
  double volume_iou = 0;
};
SolidError CompareSolids(const Solid& model, const Solid& truth);

// Centre and every extent (of a cylinder: radius and height) within the tolerance.
bool IsWithin(const SolidError& error, double tolerance_m);

}  // namespace declutter::accuracy
