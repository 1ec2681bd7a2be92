#include "modules/feature_estimator/row_sharing.h"

#include "modules/feature_estimator/lanes.h"

namespace declutter {
namespace {

constexpr float kMaxDistance = 0.25F;  // of a window's radius, to the point above

DECLUTTER_FOR_EACH_PROCESSOR bool HavePointsAbove(const PointImage& points, const float* x,
                                                  size_t begin, float radius_m) {
  const size_t above = begin - static_cast<size_t>(points.stride);
  Lanes px, py, pz, ax, ay, az;
  LoadLanes(&x[begin], px);
  LoadLanes(&points.y[begin], py);
  LoadLanes(&points.z[begin], pz);
  LoadLanes(&x[above], ax);
  LoadLanes(&points.y[above], ay);
  LoadLanes(&points.z[above], az);
  const Lanes dx = px - ax, dy = py - ay, dz = pz - az;
  const float max_distance = kMaxDistance * radius_m;
  const LaneMask is_alone =
      (px < PointImage::kFar) & (dx * dx + dy * dy + dz * dz > max_distance * max_distance);
  int32_t num_alone = 0;
  for (size_t lane = 0; lane < PointImage::kLanes; ++lane) num_alone |= is_alone[lane];
  return num_alone == 0;
}

}  // namespace

bool TakeRowAbove(const PointImage& points, const float* x, size_t begin,
                  const Neighborhood& neighborhood,
                  std::initializer_list<std::vector<float>*> planes) {
  if (neighborhood.dense_px == Neighborhood::kReadAll ||
      !HavePointsAbove(points, x, begin, static_cast<float>(neighborhood.radius_m)) ||
      SphereWindow(points, x, begin, neighborhood).stride() == 1) {
    return false;
  }
  const size_t above = begin - static_cast<size_t>(points.stride);
  for (auto* plane : planes) {
    for (size_t lane = 0; lane < PointImage::kLanes; ++lane) {
      const bool has_point = x[begin + lane] < PointImage::kFar;
      (*plane)[begin + lane] = has_point ? (*plane)[above + lane] : 0;
    }
  }
  return true;
}

}  // namespace declutter
