#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "modules/geometry/depth_image.h"

namespace declutter {

// Which features decide between flat and round, and the inlier filters that go with them.
enum class FeatureMode : int8_t {
  kDefault = 0,  // horizontal curvature kappa by regression of normals
  kPaper = 1,    // curvature and RSD minimum radius, sections 3 and 5 of the paper
};

// Features of one object point.
struct FeaturePoint {
  int32_t pixel = 0;                                 // v * width + u
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  // unit, toward the camera, in C; zero: unknown
  float kappa = 0;         // [1/m] horizontal curvature, convex > 0; 0 in paper mode
  float curvature = 0;     // [1] lambda_0 / (lambda_0 + lambda_1 + lambda_2)
  float r_min = 0;         // [m] minimum surface radius (RSD); 0 in default mode
  int32_t component = -1;  // connected component, 0 .. num_components - 1; -1: none
};

// Features of the object points of a Tabletop, in row-major order of their pixels.
struct FeatureCloud {
  FrameHeader header;
  FeatureMode mode = FeatureMode::kDefault;
  int width = 0;     // [px] of the depth image
  int height = 0;    // [px]
  int thinning = 1;  // k: only pixels with u % k = v % k = 0 are here
  int num_components = 0;
  std::vector<FeaturePoint> points;
};

}  // namespace declutter
