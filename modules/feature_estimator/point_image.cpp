#include "modules/feature_estimator/point_image.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace declutter {
namespace {

// Objects nearer than a sensor measures would ask for windows without bound.
constexpr int kMaxMargin = 64;

// A neighbour at P + e, |e| <= r, is seen |e_xy - (P_xy / z) e_z| / (z + e_z) away from P at z = 1,
// at most r sqrt(1 + |P_xy|^2 / z^2) / (z - r).
float WindowSlope(float x, float y, float z, float radius_m) {
  const float room = std::max(z - radius_m, 1e-3F);
  return radius_m * std::sqrt(x * x + y * y + z * z) / (z * room);
}

}  // namespace

PointImage MakePointImage(const Tabletop& tabletop, double max_radius_m, int min_margin_px,
                          PointImage recycled) {
  const DepthImage& image = tabletop.objects;
  const PinholeCamera& camera = image.camera;
  PointImage points = std::move(recycled);
  points.width = points.height = 0;
  points.thinning = std::max(tabletop.thinning, 1);
  const int k = points.thinning;
  int min_u = camera.width, max_u = -1, min_v = camera.height, max_v = -1;
  float max_slope = 0;
  for (int v = 0; v < (image.empty() ? 0 : camera.height); v += k) {
    const uint16_t* row = &image.counts[static_cast<size_t>(v) * static_cast<size_t>(camera.width)];
    for (int u = 0; u < camera.width; u += k) {
      if (row[u] == 0) continue;
      min_u = std::min(min_u, u);
      max_u = std::max(max_u, u);
      min_v = std::min(min_v, v);
      max_v = std::max(max_v, v);
      const Eigen::Vector3f p = image.PointAt(u, v).cast<float>();
      max_slope =
          std::max(max_slope, WindowSlope(p.x(), p.y(), p.z(), static_cast<float>(max_radius_m)));
    }
  }
  if (max_u < 0) return points;

  points.first_u = min_u;
  points.first_v = min_v;
  points.width = (max_u - min_u) / k + 1;
  points.height = (max_v - min_v) / k + 1;
  points.fx = static_cast<float>(camera.fx / k);
  points.fy = static_cast<float>(camera.fy / k);
  const float max_columns = max_slope * std::max(points.fx, points.fy);
  points.margin = static_cast<int>(std::min(max_columns, static_cast<float>(kMaxMargin))) + 1;
  points.margin = std::max(points.margin, min_margin_px);
  points.stride = points.width + 2 * points.margin + PointImage::kLanes;
  const size_t size =
      static_cast<size_t>(points.stride) * static_cast<size_t>(points.height + 2 * points.margin);
  points.x.assign(size, PointImage::kFar);
  points.y.assign(size, PointImage::kFar);
  points.z.assign(size, PointImage::kFar);
  for (int j = 0; j < points.height; ++j) {
    const int v = min_v + j * k;
    const uint16_t* row = &image.counts[static_cast<size_t>(v) * static_cast<size_t>(camera.width)];
    for (int i = 0; i < points.width; ++i) {
      const int u = min_u + i * k;
      if (row[u] == 0) continue;
      const Eigen::Vector3f p = image.PointAt(u, v).cast<float>();
      const size_t index = points.Index(i, j);
      points.x[index] = p.x();
      points.y[index] = p.y();
      points.z[index] = p.z();
    }
  }
  return points;
}

SphereWindow::SphereWindow(const PointImage& points, const float* x, size_t begin,
                           const Neighborhood& neighborhood)
    : fx_(points.fx), inverse_fy_(1 / points.fy), margin_(points.margin) {
  for (size_t i = begin; i < begin + PointImage::kLanes; ++i) {
    if (x[i] >= PointImage::kFar) continue;
    slope_ = std::max(slope_, WindowSlope(points.x[i], points.y[i], points.z[i],
                                          static_cast<float>(neighborhood.radius_m)));
  }
  num_rows_ = std::min(static_cast<int>(slope_ * points.fy), margin_);
  stride_ = 1 + num_rows_ / (neighborhood.dense_px + 1);
  num_rows_ = num_rows_ / stride_ * stride_;
}

}  // namespace declutter
