#include "tests/accuracy/radius_bound.h"

#include <Eigen/Dense>
#include <cmath>

#include "modules/scene_renderer/sensor_model.h"

namespace declutter::accuracy {
namespace {

// Where a ray meets the side of a cylinder.
struct SidePoint {
  double z = 0;       // [m] depth
  Eigen::Vector2d n;  // outward normal along x and y of O
  double cosine = 0;  // of incidence
};

std::optional<SidePoint> Meet(const Solid& cylinder, const Eigen::Isometry3d& X_OC,
                              const Eigen::Vector3d& ray_C) {
  const Eigen::Vector3d ray_O = X_OC.linear() * ray_C;
  const Eigen::Vector3d camera_O = X_OC.translation();
  const double a = ray_O.head<2>().squaredNorm();
  const double b = ray_O.head<2>().dot(camera_O.head<2>());
  const double c = camera_O.head<2>().squaredNorm() - cylinder.radius() * cylinder.radius();
  const double discriminant = b * b - a * c;
  if (!(discriminant > 0 && a > 0)) return std::nullopt;
  SidePoint point;
  point.z = (-b - std::sqrt(discriminant)) / a;
  const Eigen::Vector3d p_O = camera_O + point.z * ray_O;
  if (point.z <= 0 || std::abs(p_O.z()) > 0.5 * cylinder.height()) return std::nullopt;
  point.n = p_O.head<2>() / cylinder.radius();
  point.cosine = -point.n.dot(ray_O.head<2>()) / ray_O.norm();
  return point;
}

}  // namespace

std::optional<double> RadiusBound(const Solid& cylinder, const PinholeCamera& camera,
                                  const std::vector<int>& pixels, const SceneNoise& noise) {
  constexpr int kMinPx = 60;
  if (noise.model() == "none") return std::nullopt;
  const Eigen::Isometry3d X_OC = cylinder.X_CO.inverse();
  const double min_cosine = std::cos(noise.max_incidence_rad());
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  // of centre x, y and radius
  int num = 0;
  for (const int pixel : pixels) {
    const Eigen::Vector3d ray_C = camera.Ray(pixel % camera.width, pixel / camera.width);
    const auto point = Meet(cylinder, X_OC, ray_C);
    if (!point || point->cosine < min_cosine) continue;
    const double sigma = DepthSigma(noise, point->z) * ray_C.norm() * point->cosine;
    const Eigen::Vector3d J(point->n.x(), point->n.y(), 1);
    information += J * J.transpose() / (sigma * sigma);
    ++num;
  }
  if (num < kMinPx) return std::nullopt;
  const double variance = PixelsPerSample(noise) * information.inverse()(2, 2);
  return variance > 0 && std::isfinite(variance) ? std::optional(std::sqrt(variance))
                                                 : std::nullopt;
}

}  // namespace declutter::accuracy
