#include "modules/feature_estimator/point_image.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace declutter {
namespace {

// Objects nearer than a sensor measures would ask for windows without bound.

// A neighbour at P + e, |e| <= r, is seen |e_xy - (P_xy / z) e_z| / (z + e_z) away from P at z = 1,
// at most r sqrt(1 + |P_xy|^2 / z^2) / (z - r).
float WindowSlope(float x, float y, float z, float radius_m) {
  const float room = std::max(z - radius_m, 1e-3F);
  return radius_m * std::sqrt(x * x + y * y + z * z) / (z * room);
}

const uint16_t* RowOf(const DepthImage& image, int v) {
  return &image.counts[static_cast<size_t>(v) * static_cast<size_t>(image.camera.width)];
}

// Of the measured pixels [px], and the nearest depth.
struct Bounds {
  int min_u = 0, max_u = -1, min_v = 0, max_v = -1;
  uint16_t min_count = 0;
};

// Of every step-th pixel.
Bounds BoundsOf(const DepthImage& image, int step) {
  Bounds bounds;
  bounds.min_u = image.camera.width;
  unsigned min_before_zero = 0xFFFF;  // count - 1: where nothing is measured, the largest
  for (int v = 0; v < (image.empty() ? 0 : image.camera.height); v += step) {
    const uint16_t* row = RowOf(image, v);
    const int end = (image.camera.width - 1) / step * step + step;
    int first = 0, last = end - step;
    while (first < end && row[first] == 0) first += step;
    if (first == end) continue;
    while (row[last] == 0) last -= step;
    for (int u = first; u <= last; u += step) {
      min_before_zero = std::min<unsigned>(min_before_zero, static_cast<uint16_t>(row[u] - 1));
    }
    bounds.min_u = std::min(bounds.min_u, first);
    bounds.max_u = std::max(bounds.max_u, last);
    if (bounds.max_v < 0) bounds.min_v = v;
    bounds.max_v = v;
  }
  bounds.min_count = static_cast<uint16_t>(min_before_zero + 1);
  return bounds;
}

// No window of this radius around a pixel within the bounds has a greater slope.
float MaxSlope(const Bounds& bounds, const DepthImage& image, float radius_m) {
  const double z = bounds.min_count * image.depth_scale_m;
  float max_slope = 0;
  for (const int u : {bounds.min_u, bounds.max_u}) {
    for (const int v : {bounds.min_v, bounds.max_v}) {
      const Eigen::Vector3f p = (z * image.camera.Ray(u, v)).cast<float>();
      max_slope = std::max(max_slope, WindowSlope(p.x(), p.y(), p.z(), radius_m));
    }
  }
  return max_slope;
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
  const Bounds bounds = BoundsOf(image, k);
  if (bounds.max_u < 0) return points;

  points.first_u = bounds.min_u;
  points.first_v = bounds.min_v;
  points.width = (bounds.max_u - bounds.min_u) / k + 1;
  points.height = (bounds.max_v - bounds.min_v) / k + 1;
  points.fx = static_cast<float>(camera.fx / k);
  points.fy = static_cast<float>(camera.fy / k);
  const float max_columns =
      MaxSlope(bounds, image, static_cast<float>(max_radius_m)) * std::max(points.fx, points.fy);
  const int window =
      static_cast<int>(std::min(max_columns, static_cast<float>(PointImage::kMaxWindow - 1))) + 1;
  points.margin = std::max(window, min_margin_px);
  points.stride = points.width + 2 * points.margin + PointImage::kLanes;
  const size_t size =
      static_cast<size_t>(points.stride) * static_cast<size_t>(points.height + 2 * points.margin);
  for (auto* plane : {&points.x, &points.y, &points.z}) plane->assign(size, PointImage::kFar);
  std::vector<float> ray_x;
  for (int i = 0; i < points.width; ++i) {
    ray_x.push_back(static_cast<float>(camera.Ray(bounds.min_u + i * k, 0).x()));
  }
  const auto scale = static_cast<float>(image.depth_scale_m);
  for (int j = 0; j < points.height; ++j) {
    const int v = bounds.min_v + j * k;
    const uint16_t* counts = RowOf(image, v) + bounds.min_u;
    const auto ray_y = static_cast<float>(camera.Ray(0, v).y());
    float* const x = &points.x[points.Index(0, j)];
    float* const y = &points.y[points.Index(0, j)];
    float* const z = &points.z[points.Index(0, j)];
    for (int i = 0; i < points.width; ++i) {
      if (counts[i * k] == 0) continue;
      const float depth = scale * static_cast<float>(counts[i * k]);
      x[i] = ray_x[static_cast<size_t>(i)] * depth;
      y[i] = ray_y * depth;
      z[i] = depth;
    }
  }
  return points;
}

}  // namespace declutter
