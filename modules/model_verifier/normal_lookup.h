#pragma once

#include <Eigen/Core>
#include <vector>

#include "modules/geometry/depth_image.h"

namespace declutter {

// Surface normals of a depth image, one for 2 x 2 pixels, each computed when it is first asked for.
class NormalLookup {
 public:
  // image must outlive this.
  explicit NormalLookup(const DepthImage& image);

  // Unit normal at pixel (u, v) toward the camera, in C; zero where the surface around the pixel is
  // not smooth or not measured. From the gradient of inverse depth, which is constant on a plane,
  // across about 24 mm.
  const Eigen::Vector3f& At(int u, int v) const;

 private:
  Eigen::Vector3f Compute(int u, int v) const;
  // Mean inverse depth of 3 x 3 pixels around (u, v) on one surface [1/m]; 0: not measured.
  float MeanInverseDepth(int u, int v) const;

  const DepthImage& image_;
  mutable std::vector<char> is_known_;
  mutable std::vector<Eigen::Vector3f> normals_;
};

}  // namespace declutter
