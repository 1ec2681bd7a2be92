#pragma once

#include <Eigen/Core>
#include <vector>

#include "modules/geometry/depth_image.h"
#include "modules/geometry/plane.h"

namespace declutter {

// A horizontal surface that carries objects.
struct SupportPlane {
  Plane plane;  // in C
  std::vector<Eigen::Vector3f>
      hull;  // [m] convex hull in C, counter-clockwise seen from the camera
};

// The support planes of a frame and the depth of the pixels that stand on them.
struct Tabletop {
  FrameHeader header;
  std::vector<SupportPlane> planes;  // main support first; empty when none was found
  DepthImage objects;                // depth of object pixels, 0 elsewhere
  int thinning = 1;                  // k: only pixels with u % k = v % k = 0 were kept
  int num_object_points = 0;         // before thinning
};

}  // namespace declutter
