#pragma once

#include <Eigen/Core>
#include <vector>

#include "modules/geometry/depth_image.h"
#include "modules/model_verifier/pixel_grid.h"

namespace declutter {

// Surface normals of a depth image, one for 2 x 2 pixels: unit vectors toward the camera, in C;
// zero where the surface around a pixel is not smooth or not measured. From the gradient of inverse
// depth, which is constant on a plane, across about 24 mm.
class GradientNormals {
 public:
  static constexpr int kStep = 2;  // [px] from one normal to the next

  // The normals of an image whose grids of all and of every kStep-th pixel are given.
  void Compute(const PinholeCamera& camera, const PixelGrid& all, const PixelGrid& every_second);

  // The normal at pixel (u, v) of the image.
  Eigen::Vector3f At(int u, int v) const {
    const size_t i = static_cast<size_t>(v / kStep) * stride_ + static_cast<size_t>(u / kStep);
    return {x_[i], y_[i], z_[i]};
  }

  // Planes of the components, row-major, with PixelGrid::kPadding elements behind the last one.
  const float* x() const { return x_.data(); }
  const float* y() const { return y_.data(); }
  const float* z() const { return z_.data(); }
  size_t stride() const { return stride_; }

 private:
  size_t stride_ = 0;
  std::vector<float> x_, y_, z_;
  std::vector<float> inverse_depth_;  // [1/m] of all pixels, 0: not measured
  std::vector<float> means_;          // of it around all pixels, and a margin of zeros
  size_t means_stride_ = 0;
};

}  // namespace declutter
