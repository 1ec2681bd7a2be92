#pragma once

#include <cstdint>
#include <vector>

#include "modules/geometry/depth_image.h"
#include "modules/geometry/solid.h"

namespace declutter {

// What every pixel sees, without a sensor. All arrays are row-major, camera.num_pixels() long.
struct IdealImage {
  PinholeCamera camera;
  std::vector<float> z;              // [m] in C; 0 where nothing is seen
  std::vector<int16_t> solid;        // index of the solid seen; -1: none
  std::vector<uint8_t> face;         // box: 2 * axis, + 1 for the positive side; cylinder: 0 side,
                                     // 4 lower and 5 upper face
  std::vector<float> incidence;      // cosine of the angle between ray and surface normal
  std::vector<int32_t> num_covered;  // [px] per solid: pixels it would have alone in the image
};

// Exact intersection of the rays of all pixel centres with the solids. The solids must be in front
// of the camera or enclose no part of it.
IdealImage CastRays(const PinholeCamera& camera, const std::vector<Solid>& solids);

}  // namespace declutter
