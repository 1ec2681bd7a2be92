#include "modules/feature_estimator/point_image.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "modules/geometry/for_each_processor.h"

namespace declutter {
namespace {

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

// The least count - 1 of every step-th pixel: where nothing is measured, it is the largest.
DECLUTTER_FOR_EACH_PROCESSOR uint16_t MinBeforeZero(const uint16_t* counts, int num, int step) {
  uint16_t min_before_zero = 0xFFFF;
  for (int i = 0; i < num; i += step) {
    min_before_zero = std::min(min_before_zero, static_cast<uint16_t>(counts[i] - 1));
  }
  return min_before_zero;
}

// Of every step-th pixel.
Bounds BoundsOf(const DepthImage& image, int step) {
  Bounds bounds;
  bounds.min_u = image.camera.width;
  uint16_t min_before_zero = 0xFFFF;
  for (int v = 0; v < (image.empty() ? 0 : image.camera.height); v += step) {
    const uint16_t* row = RowOf(image, v);
    const int end = (image.camera.width - 1) / step * step + step;
    int first = 0, last = end - step;
    while (first < end && row[first] == 0) first += step;
    if (first == end) continue;
    while (row[last] == 0) last -= step;
    min_before_zero = std::min(min_before_zero, MinBeforeZero(row + first, last - first + 1, step));
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

// num elements of row j from column i on.
void FillFar(int i, int num, int j, PointImage* points) {
  const auto begin = static_cast<std::ptrdiff_t>(points->Index(0, 0)) + j * points->stride + i;
  for (auto* plane : {&points->x, &points->y, &points->z}) {
    std::fill_n(plane->begin() + begin, num, PointImage::kFar);
  }
}

// The row of points that begins with this element, from every step-th count.
DECLUTTER_FOR_EACH_PROCESSOR void FillRow(const uint16_t* counts, int step, float scale,
                                          float ray_y, size_t begin, PointImage* points) {
  const float* ray_x = points->ray_x.data();
  float* const x = &points->x[begin];
  float* const y = &points->y[begin];
  float* const z = &points->z[begin];
  const int width = points->width;
  const float far = PointImage::kFar;
#pragma GCC ivdep
  for (int i = 0; i < width; ++i) {
    const uint16_t count = counts[i * step];
    const float depth = scale * static_cast<float>(count);
    x[i] = count > 0 ? ray_x[i] * depth : far;
    y[i] = count > 0 ? ray_y * depth : far;
    z[i] = count > 0 ? depth : far;
  }
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
  for (auto* plane : {&points.x, &points.y, &points.z}) plane->resize(size);
  points.ray_x.clear();
  for (int i = 0; i < points.width; ++i) {
    points.ray_x.push_back(static_cast<float>(camera.Ray(bounds.min_u + i * k, 0).x()));
  }
  for (int j = -points.margin; j < points.height + points.margin; ++j) {
    if (j < 0 || j >= points.height) {
      FillFar(-points.margin, points.stride, j, &points);
      continue;
    }
    const int v = bounds.min_v + j * k;
    FillFar(-points.margin, points.margin, j, &points);
    FillRow(RowOf(image, v) + bounds.min_u, k, static_cast<float>(image.depth_scale_m),
            static_cast<float>(camera.Ray(0, v).y()), points.Index(0, j), &points);
    FillFar(points.width, points.margin + PointImage::kLanes, j, &points);
  }
  return points;
}

}  // namespace declutter
