#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "modules/geometry/depth_image.h"
#include "modules/geometry/feature_cloud.h"
#include "modules/geometry/plane.h"

namespace declutter {

enum class Shape : int8_t { kBox = 0, kCylinder = 1 };

// A complete box or cylinder. O is its centre; z of O is the axis of a cylinder and the support
// normal of a standing box.
struct Solid {
  Shape shape = Shape::kBox;
  Eigen::Isometry3d X_CO = Eigen::Isometry3d::Identity();
  Eigen::Vector3d size =
      Eigen::Vector3d::Zero();  // [m] along x, y, z of O; cylinder: 2r, 2r, height

  double radius() const { return 0.5 * size.x(); }
  double height() const { return size.z(); }
};

// What an extent of a solid rests on.
enum class Evidence : int8_t { kObserved = 0, kFreeSpace = 1, kAssumed = 2 };

// A solid proposed by a segmenter.
struct Hypothesis {
  Solid solid;
  std::array<Evidence, 3> evidence{};  // of the extents along x, y, z of O
  int32_t component = 0;               // connected component it was found in
  int32_t num_votes = 0;               // votes in the peak of the parameter space
  int32_t num_inliers = 0;             // points of the component on its surface
  float score = 0;                     // support in [0, 1]
};

// Hypotheses of a frame, best first.
struct HypothesisList {
  FrameHeader header;
  FeatureMode mode = FeatureMode::kDefault;
  std::vector<Plane> planes;  // support planes in C, main support first
  std::vector<Hypothesis> hypotheses;
};

// Covariance of what places and measures a solid: position of the centre along x, y, z of O [m],
// extents along x, y, z of O [m], rotation about z of O [rad].
using SolidCovariance = Eigen::Matrix<double, 7, 7>;

// A solid that agrees with the depth image.
struct ObjectModel {
  int32_t id = 0;  // 1 .. number of objects: its value in the label image
  Solid solid;
  std::array<Evidence, 3> evidence{};
  float confidence = 0;      // in [0, 1]
  int32_t supported_by = 0;  // id of the object it stands on, 0: the main support
  int32_t num_votes = 0;     // votes in the peak of the parameter space
  // Of the solid as far as it is seen.
  int32_t num_explained = 0;  // [px] measured on its surface
  int32_t num_occluded = 0;   // [px] hidden by something in front
  int32_t num_violating = 0;  // [px] measured behind its surface: free space inside the solid
  SolidCovariance covariance = SolidCovariance::Zero();
};

// The verified objects of a frame.
struct ObjectList {
  FrameHeader header;
  FeatureMode mode = FeatureMode::kDefault;
  PinholeCamera camera;  // of the label image
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  std::vector<Plane> planes;  // support planes in C, main support first
  std::vector<ObjectModel> objects;
  std::vector<uint8_t> labels;  // row-major, camera.num_pixels() long: 0 or an object's id
};

}  // namespace declutter
