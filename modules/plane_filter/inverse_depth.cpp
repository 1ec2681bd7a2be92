#include "modules/plane_filter/inverse_depth.h"

#include <Eigen/Dense>

#include "modules/geometry/marked_pixels.h"
#include "modules/plane_filter/pixel_kernels.h"

namespace declutter {

InverseDepth Invert(const DepthImage& image) {
  InverseDepth inverse;
  inverse.width = image.camera.width;
  inverse.height = image.camera.height;
  for (int u = 0; u < inverse.width; ++u) {
    inverse.ray_x.push_back(static_cast<float>(image.camera.Ray(u, 0).x()));
  }
  for (int v = 0; v < inverse.height; ++v) {
    inverse.ray_y.push_back(static_cast<float>(image.camera.Ray(0, v).y()));
  }
  inverse.values.resize(image.counts.size());
  const float per_count = static_cast<float>(1.0 / image.depth_scale_m);
  for (size_t i = 0; i < image.counts.size(); ++i) {
    const float count = image.counts[i];
    inverse.values[i] = count > 0 ? per_count / count : 0;
  }
  return inverse;
}

InverseDepth Subsample(const InverseDepth& image, int stride) {
  InverseDepth grid;
  for (int u = stride / 2; u < image.width; u += stride) {
    grid.ray_x.push_back(image.ray_x[static_cast<size_t>(u)]);
  }
  for (int v = stride / 2; v < image.height; v += stride) {
    grid.ray_y.push_back(image.ray_y[static_cast<size_t>(v)]);
    for (int u = stride / 2; u < image.width; u += stride) {
      grid.values.push_back(image.values[image.Index(u, v)]);
    }
  }
  grid.width = static_cast<int>(grid.ray_x.size());
  grid.height = static_cast<int>(grid.ray_y.size());
  return grid;
}

// n . (x, y, 1) z + d = 0 gives 1 / z = -n . (x, y, 1) / d.
Plane InversePlane::ToPlane() const {
  const Eigen::Vector3d scaled(-a, -b, -c);
  return {scaled.normalized(), 1.0 / scaled.norm()};
}

PixelMask PlaneInliers(const InverseDepth& image, const InversePlane& plane, float band) {
  PixelMask mask(image.values.size());
  for (int v = 0; v < image.height; ++v) {
    const float row = plane.b * image.ray_y[static_cast<size_t>(v)] + plane.c;
    MarkPlaneInliers(image.ray_x.data(), &image.values[image.Index(0, v)],
                     static_cast<size_t>(image.width), plane.a, row, band,
                     &mask[image.Index(0, v)]);
  }
  return mask;
}

PixelMask Amid(const InverseDepth& image, const PixelMask& mask, int min_marked) {
  PixelMask amid(mask.size());
  for (int v = 1; v + 1 < image.height; ++v) {
    const uint8_t* middle = &mask[image.Index(0, v)];
    MarkAmid(middle - image.width, middle, middle + image.width, static_cast<size_t>(image.width),
             min_marked, &amid[image.Index(0, v)]);
  }
  return amid;
}

std::optional<InversePlane> FitInliers(const InverseDepth& image, const PixelMask& mask,
                                       const InversePlane& plane, float band) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d weighted = Eigen::Vector3d::Zero();
  PixelMask inliers(static_cast<size_t>(image.width));
  for (int v = 0; v < image.height; ++v) {
    const float y = image.ray_y[static_cast<size_t>(v)];
    const float row = plane.b * y + plane.c;
    const float* values = &image.values[image.Index(0, v)];
    const uint8_t* marked = &mask[image.Index(0, v)];
    float n = 0, sum_x = 0, sum_xx = 0, sum_r = 0, sum_rx = 0;
    MarkPlaneInliers(image.ray_x.data(), values, inliers.size(), plane.a, row, band,
                     inliers.data());
    ForEachMarked(inliers.data(), 0, inliers.size(), [&](size_t u) {
      if (!marked[u]) return;
      const float x = image.ray_x[u];
      const float residual = values[u] - (plane.a * x + row);
      n += 1;
      sum_x += x;
      sum_xx += x * x;
      sum_r += residual;
      sum_rx += residual * x;
    });
    Eigen::Matrix3d row_information;
    row_information << sum_xx, sum_x * y, sum_x, sum_x * y, n * y * y, n * y, sum_x, n * y, n;
    information += row_information;
    weighted += Eigen::Vector3d(sum_rx, sum_r * y, sum_r);
  }
  if (information(2, 2) < 3) return std::nullopt;
  const Eigen::LDLT<Eigen::Matrix3d> factors(information);
  // Rays of a single line leave the tilt about it open.
  if (factors.vectorD().minCoeff() < 1e-9 * information(2, 2)) return std::nullopt;
  const Eigen::Vector3f step = factors.solve(weighted).cast<float>();
  return InversePlane{plane.a + step.x(), plane.b + step.y(), plane.c + step.z()};
}

}  // namespace declutter
