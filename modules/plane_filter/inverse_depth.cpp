#include "modules/plane_filter/inverse_depth.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "modules/geometry/for_each_processor.h"
#include "modules/geometry/marked_pixels.h"
#include "modules/plane_filter/pixel_kernels.h"

namespace declutter {
namespace {

DECLUTTER_FOR_EACH_PROCESSOR void InvertCounts(const uint16_t* counts, size_t num, float per_count,
                                               float* values) {
  for (size_t i = 0; i < num; ++i) {
    const float count = counts[i];
    values[i] = count > 0 ? per_count / count : 0;
  }
}

// Over the inliers of a row, x of their rays and residuals r [1/m].
struct RowSums {
  float n = 0, x = 0, xx = 0, r = 0, rx = 0;
};

RowSums SumInliers(const std::vector<float>& ray_x, const float* values, const uint8_t* marked,
                   float a, float row, float band) {
  constexpr size_t kPart = 256;
  std::array<uint8_t, kPart> inliers;
  RowSums sums;
  for (size_t begin = 0; begin < ray_x.size(); begin += kPart) {
    const size_t num = std::min(kPart, ray_x.size() - begin);
    MarkPlaneInliers(&ray_x[begin], values + begin, num, a, row, band, inliers.data());
    if (marked != nullptr) {
      for (size_t i = 0; i < num; ++i) inliers[i] &= marked[begin + i];
    }
    ForEachMarked(inliers.data(), 0, num, [&](size_t i) {
      const float x = ray_x[begin + i];
      const float r = values[begin + i] - (a * x + row);
      sums.n += 1;
      sums.x += x;
      sums.xx += x * x;
      sums.r += r;
      sums.rx += r * x;
    });
  }
  return sums;
}

}  // namespace

InverseDepth Invert(const DepthImage& image, InverseDepth recycled) {
  InverseDepth inverse = std::move(recycled);
  inverse.width = image.camera.width;
  inverse.height = image.camera.height;
  inverse.ray_x.clear();
  inverse.ray_y.clear();
  for (int u = 0; u < inverse.width; ++u) {
    inverse.ray_x.push_back(static_cast<float>(image.camera.Ray(u, 0).x()));
  }
  for (int v = 0; v < inverse.height; ++v) {
    inverse.ray_y.push_back(static_cast<float>(image.camera.Ray(0, v).y()));
  }
  inverse.values.resize(image.counts.size());
  InvertCounts(image.counts.data(), image.counts.size(),
               static_cast<float>(1.0 / image.depth_scale_m), inverse.values.data());
  return inverse;
}

InverseDepth Subsample(const InverseDepth& image, int stride, InverseDepth recycled) {
  InverseDepth grid = std::move(recycled);
  grid.ray_x.clear();
  grid.ray_y.clear();
  for (int u = stride / 2; u < image.width; u += stride) {
    grid.ray_x.push_back(image.ray_x[static_cast<size_t>(u)]);
  }
  for (int v = stride / 2; v < image.height; v += stride) {
    grid.ray_y.push_back(image.ray_y[static_cast<size_t>(v)]);
  }
  grid.width = static_cast<int>(grid.ray_x.size());
  grid.height = static_cast<int>(grid.ray_y.size());
  grid.values.resize(grid.ray_x.size() * grid.ray_y.size());
  for (int v = 0; v < grid.height; ++v) {
    const float* from = &image.values[image.Index(stride / 2, stride / 2 + v * stride)];
    float* to = &grid.values[grid.Index(0, v)];
    for (int u = 0; u < grid.width; ++u) to[u] = from[u * stride];
  }
  return grid;
}

// n . (x, y, 1) z + d = 0 gives 1 / z = -n . (x, y, 1) / d.
Plane InversePlane::ToPlane() const {
  const Eigen::Vector3d scaled(-a, -b, -c);
  return {scaled.normalized(), 1.0 / scaled.norm()};
}

PixelMask PlaneInliers(const InverseDepth& image, const InversePlane& plane, float band,
                       PixelMask recycled) {
  PixelMask mask = std::move(recycled);
  mask.resize(image.values.size());
  for (int v = 0; v < image.height; ++v) {
    const float row = plane.b * image.ray_y[static_cast<size_t>(v)] + plane.c;
    MarkPlaneInliers(image.ray_x.data(), &image.values[image.Index(0, v)],
                     static_cast<size_t>(image.width), plane.a, row, band,
                     &mask[image.Index(0, v)]);
  }
  return mask;
}

PixelMask Amid(const InverseDepth& image, const PixelMask& mask, int min_marked,
               PixelMask recycled) {
  PixelMask amid = std::move(recycled);
  amid.resize(mask.size());
  const size_t last = static_cast<size_t>(image.width) - 1;
  for (int v = 0; v < image.height; ++v) {
    uint8_t* row = &amid[image.Index(0, v)];
    if (v == 0 || v == image.height - 1) {
      std::memset(row, 0, last + 1);
      continue;
    }
    row[0] = row[last] = 0;
    const uint8_t* middle = &mask[image.Index(0, v)];
    MarkAmid(middle - image.width, middle, middle + image.width, static_cast<size_t>(image.width),
             min_marked, row);
  }
  return amid;
}

std::optional<InversePlane> FitInliers(const InverseDepth& image, const PixelMask* mask,
                                       const InversePlane& plane, float band) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d weighted = Eigen::Vector3d::Zero();
  for (int v = 0; v < image.height; ++v) {
    const float y = image.ray_y[static_cast<size_t>(v)];
    const float row = plane.b * y + plane.c;
    const size_t begin = image.Index(0, v);
    const RowSums sums =
        SumInliers(image.ray_x, &image.values[begin], mask == nullptr ? nullptr : &(*mask)[begin],
                   plane.a, row, band);
    Eigen::Matrix3d row_information;
    row_information << sums.xx, sums.x * y, sums.x, sums.x * y, sums.n * y * y, sums.n * y, sums.x,
        sums.n * y, sums.n;
    information += row_information;
    weighted += Eigen::Vector3d(sums.rx, sums.r * y, sums.r);
  }
  if (information(2, 2) < 3) return std::nullopt;
  const Eigen::LDLT<Eigen::Matrix3d> factors(information);
  // Rays of a single line leave the tilt about it open.
  if (factors.vectorD().minCoeff() < 1e-9 * information(2, 2)) return std::nullopt;
  const Eigen::Vector3f step = factors.solve(weighted).cast<float>();
  return InversePlane{plane.a + step.x(), plane.b + step.y(), plane.c + step.z()};
}

}  // namespace declutter
