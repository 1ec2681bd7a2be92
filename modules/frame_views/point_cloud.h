#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "modules/geometry/depth_image.h"
#include "modules/geometry/solid.h"

namespace declutter {

struct CloudPoint {
  Eigen::Vector3f p_C;  // [m] not a number where nothing was measured
  uint32_t rgb = 0;     // 0xRRGGBB
  uint32_t label = 0;   // id of an object, else 0
};

// Points in camera frame C.
struct PointCloud {
  int width = 0;   // points of a row; of the whole cloud when it is no image
  int height = 0;  // 1 when it is no image
  std::vector<CloudPoint> points;
};

// The depth image as a cloud of its size. Colour and labels where there is an image of that size;
// else white, and no object. color and objects may be null.
PointCloud MeasuredCloud(const DepthImage& depth, const ColorImage* color,
                         const ObjectList* objects);

// Points of the surfaces of all objects, about spacing_m apart, hidden ones too, in the colours of
// the overlay. Fewer, farther apart, where a solid would have more than a million.
PointCloud ModelCloud(const ObjectList& objects, double spacing_m);

// The bytes of a .pcd file of the Point Cloud Library, with fields x y z rgb label.
std::string PcdFile(const PointCloud& cloud);

}  // namespace declutter
