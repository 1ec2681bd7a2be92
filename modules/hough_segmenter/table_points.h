#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "modules/geometry/feature_cloud.h"
#include "modules/geometry/tabletop.h"

namespace declutter {

// A point of an object's surface in the table frame T of the main support plane.
struct SurfacePoint {
  Eigen::Vector3f p_T;  // [m]
  Eigen::Vector3f n_T;  // unit normal, toward the camera
  float sigma;          // [m] standard deviation of the measurement along its ray
  int component;

  // Part of a horizontal face, seen from above.
  bool is_top() const { return n_T.z() > 0.90f; }
  // More than 24 degrees from both: on a box only at its edges.
  bool is_slanted() const { return n_T.z() > 0.40f && n_T.z() < 0.90f; }
  // Part of a vertical face: its normal is within 30 degrees of the horizontal.
  bool is_side() const { return n_T.z() < 0.50f && n_T.z() > -0.50f; }
};

// The same with its pixel and its other features.
struct TablePoint : SurfacePoint {
  float kappa;      // [1/m] horizontal curvature (default mode)
  float curvature;  // [1] (paper mode)
  float r_min;      // [m] (paper mode)
  int u;            // [px]
  int v;            // [px]
};

// Replaces points by all points of the cloud with a known normal, in T and row-major order; X_TC is
// the pose of the camera in T.
void FindTablePoints(const Tabletop& tabletop, const FeatureCloud& features,
                     const Eigen::Isometry3d& X_TC, std::vector<TablePoint>* points);

}  // namespace declutter
