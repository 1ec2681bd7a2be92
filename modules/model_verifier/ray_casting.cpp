#include "modules/model_verifier/ray_casting.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "modules/geometry/sensor_noise.h"

namespace declutter {
namespace {

constexpr double kMaxOverhang = 0.015;       // [m] beside a solid that its top face is looked for
constexpr double kMinTolerance = 0.005;      // [m] of points on a surface
constexpr double kToleranceInSigmas = 3;     // of points on a surface
constexpr double kSurfaceMinHeight = 0.8;    // [tolerances] of points of objects
constexpr double kNeighbourMinHeight = 1.5;  // [tolerances] of points that need an explanation

// min_height: in tolerances, of points that are no part of the support plane.
RayLimits LimitsWith(double min_height) {
  RayLimits limits;
  limits.min_tolerance_m = static_cast<float>(kMinTolerance);
  limits.tolerance_per_square = static_cast<float>(kToleranceInSigmas * kSigmaPerSquaredDepth);
  limits.min_height_in_tolerances = static_cast<float>(min_height);
  limits.edge_margin_m = 0.012f;
  limits.max_overhang_m = static_cast<float>(kMaxOverhang);
  limits.top_tolerance_m = 0.004f;
  limits.min_normal_cos = 0.85f;  // 32 degrees
  return limits;
}

RaySolid MakeRaySolid(const Solid& solid, const Plane& support) {
  RaySolid made;
  const Eigen::Isometry3d X_OC = solid.X_CO.inverse();
  const Eigen::Vector3d camera_O = X_OC.translation();
  made.is_cylinder = solid.shape == Shape::kCylinder;
  for (int i = 0; i < 3; ++i) {
    made.half_size[i] = static_cast<float>(0.5 * solid.size[i]);
    made.camera_O[i] = static_cast<float>(camera_O[i]);
    made.support[i] = static_cast<float>(support.normal[i]);
    for (int j = 0; j < 3; ++j) made.R_OC[3 * i + j] = static_cast<float>(X_OC.linear()(i, j));
  }
  made.support[3] = static_cast<float>(support.d);
  return made;
}

RayWindow WindowOf(const Solid& solid, double margin_m, const Observation& observation) {
  const PixelWindow pixels = ProjectionWindow(solid, margin_m, observation.image.camera);
  const PixelGrid& grid = observation.grid;
  const NormalImage& normals = observation.normals;
  RayWindow window;
  window.ray_x = grid.ray_x.data();
  window.ray_y = grid.ray_y.data();
  window.z = grid.z.data();
  window.stride = grid.stride;
  window.normal_x = normals.x();
  window.normal_y = normals.y();
  window.normal_z = normals.z();
  window.normal_stride = normals.stride();
  window.normal_shift = grid.step == NormalImage::kStep ? 0 : 1;
  window.columns = grid.columns;
  window.u_begin = observation.First(pixels.u_begin);
  window.u_end = observation.First(pixels.u_end);
  window.v_begin = observation.First(pixels.v_begin);
  window.v_end = observation.First(pixels.v_end);
  return window;
}

}  // namespace

PixelWindow ProjectionWindow(const Solid& solid, double margin_m, const PinholeCamera& camera) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::max());
  Eigen::Vector2d high = -low;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d sign((corner & 1) - 0.5, ((corner >> 1) & 1) - 0.5,
                               ((corner >> 2) & 1) - 0.5);
    const Eigen::Vector3d p_C =
        solid.X_CO * sign.cwiseProduct(solid.size + Eigen::Vector3d::Constant(2 * margin_m));
    if (p_C.z() <= 0.05) return {0, camera.width, 0, camera.height};
    const Eigen::Vector2d pixel = camera.Project(p_C);
    low = low.cwiseMin(pixel);
    high = high.cwiseMax(pixel);
  }
  const auto clamp = [](double x, int limit) {
    return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(limit)));
  };
  return {clamp(std::floor(low.x()), camera.width), clamp(std::ceil(high.x()) + 1, camera.width),
          clamp(std::floor(low.y()), camera.height), clamp(std::ceil(high.y()) + 1, camera.height)};
}

SolidCaster::SolidCaster(const Solid& solid)
    : shape_(solid.shape), half_size_(0.5 * solid.size), X_OC_(solid.X_CO.inverse()) {}

double SolidCaster::SignedDistance(const Eigen::Vector3d& p) const {
  if (shape_ == Shape::kBox) {
    const Eigen::Vector3d q = p.cwiseAbs() - half_size_;
    return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
  }
  const Eigen::Vector2d q(p.head<2>().norm() - half_size_.x(), std::abs(p.z()) - half_size_.z());
  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
}

RayEvidence CastRays(const Solid& solid, const Observation& observation, RayEvidence recycled) {
  static const RayLimits kLimits = LimitsWith(kSurfaceMinHeight);
  RayEvidence evidence = std::move(recycled);
  const RayWindow window = WindowOf(solid, kMaxOverhang, observation);
  const auto room = static_cast<size_t>(window.u_end - window.u_begin) *
                        static_cast<size_t>(window.v_end - window.v_begin) +
                    kRayPadding;
  evidence.explained.resize(room);
  evidence.fits.resize(room);
  evidence.hollow.resize(solid.shape == Shape::kCylinder ? room : 0);
  RayCounts counts;
  counts.explained = evidence.explained.data();
  counts.fits = evidence.fits.data();
  counts.hollow = evidence.hollow.data();
  CastWindow(MakeRaySolid(solid, observation.support), window, kLimits, &counts);
  evidence.explained.resize(static_cast<size_t>(counts.num_explained));
  evidence.fits.resize(static_cast<size_t>(counts.num_explained));
  evidence.hollow.resize(static_cast<size_t>(counts.num_hollow));
  evidence.fit_sum = counts.fit;
  const int weight = observation.grid.pixel_weight();
  evidence.pixel_weight = weight;
  evidence.num_contradicting = weight * counts.num_contradicting;
  evidence.num_occluded = weight * counts.num_occluded;
  evidence.num_violating = weight * counts.num_violating;
  evidence.num_overhanging = weight * counts.num_overhanging;
  evidence.num_unknown = weight * counts.num_unknown;
  return evidence;
}

int NumNear(const Solid& solid, double reach_m, const Observation& observation) {
  static const RayLimits kLimits = LimitsWith(kNeighbourMinHeight);
  return CountNear(MakeRaySolid(solid, observation.support), WindowOf(solid, reach_m, observation),
                   kLimits, static_cast<float>(reach_m));
}

double SurfaceTolerance(double z) {
  return std::max(kMinTolerance, kToleranceInSigmas * MeasurementSigma(z));
}

}  // namespace declutter
