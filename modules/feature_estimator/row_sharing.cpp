#include "modules/feature_estimator/row_sharing.h"

#include "modules/feature_estimator/lanes.h"

namespace declutter {
namespace {

constexpr float kMaxDistance = 0.25F;  // of a window's radius, to the point there

size_t Shifted(const PointImage& points, size_t begin, int rows) {
  return static_cast<size_t>(static_cast<ptrdiff_t>(begin) + rows * points.stride);
}

DECLUTTER_FOR_EACH_PROCESSOR bool HavePointsAt(const PointImage& points, const float* x,
                                               size_t begin, size_t other, float radius_m) {
  Lanes px, py, pz, ax, ay, az;
  LoadLanes(&x[begin], px);
  LoadLanes(&points.y[begin], py);
  LoadLanes(&points.z[begin], pz);
  LoadLanes(&x[other], ax);
  LoadLanes(&points.y[other], ay);
  LoadLanes(&points.z[other], az);
  const Lanes dx = px - ax, dy = py - ay, dz = pz - az;
  const float max_distance = kMaxDistance * radius_m;
  const LaneMask is_alone =
      (px < PointImage::kFar) & (dx * dx + dy * dy + dz * dz > max_distance * max_distance);
  int32_t num_alone = 0;
  for (size_t lane = 0; lane < PointImage::kLanes; ++lane) num_alone |= is_alone[lane];
  return num_alone == 0;
}

}  // namespace

bool TakeRow(const PointImage& points, const float* x, size_t begin, int source,
             const Neighborhood& neighborhood, std::initializer_list<std::vector<float>*> planes) {
  const size_t other = Shifted(points, begin, source);
  if (neighborhood.dense_px == Neighborhood::kReadAll ||
      !HavePointsAt(points, x, begin, other, static_cast<float>(neighborhood.radius_m)) ||
      SphereWindow(points, x, begin, neighborhood).stride() == 1) {
    return false;
  }
  for (auto* plane : planes) {
    for (size_t lane = 0; lane < PointImage::kLanes; ++lane) {
      const bool has_point = x[begin + lane] < PointImage::kFar;
      (*plane)[begin + lane] = has_point ? (*plane)[other + lane] : 0;
    }
  }
  return true;
}

}  // namespace declutter
