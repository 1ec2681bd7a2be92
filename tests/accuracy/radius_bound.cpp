#include "tests/accuracy/radius_bound.h"

#include <Eigen/Dense>
#include <cmath>

#include "modules/scene_renderer/ray_caster.h"
#include "modules/scene_renderer/sensor_model.h"

namespace declutter::accuracy {

std::optional<double> RadiusBound(const Solid& cylinder, const PinholeCamera& camera,
                                  const std::vector<int>& pixels, const SceneNoise& noise) {
  constexpr int kMinPx = 60;
  constexpr uint8_t kSide = 0;  // face of a cylinder
  if (noise.model() == "none") return std::nullopt;
  const IdealImage seen = CastRays(camera, {cylinder});
  const Eigen::Isometry3d X_OC = cylinder.X_CO.inverse();
  const double min_cosine = std::cos(noise.max_incidence_rad());
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  // of centre x, y and radius
  int num = 0;
  for (const int pixel : pixels) {
    const auto i = static_cast<size_t>(pixel);
    const double cosine = static_cast<double>(seen.incidence[i]);
    if (seen.solid[i] < 0 || seen.face[i] != kSide || cosine < min_cosine) continue;
    const double z = static_cast<double>(seen.z[i]);
    const Eigen::Vector3d ray_C = camera.Ray(pixel % camera.width, pixel / camera.width);
    const double sigma = DepthSigma(noise, z) * ray_C.norm() * cosine;
    const Eigen::Vector2d n = (X_OC * (z * ray_C)).head<2>() / cylinder.radius();
    const Eigen::Vector3d J(n.x(), n.y(), 1);
    information += J * J.transpose() / (sigma * sigma);
    ++num;
  }
  if (num < kMinPx) return std::nullopt;
  const double variance = PixelsPerSample(noise) * information.inverse()(2, 2);
  return variance > 0 && std::isfinite(variance) ? std::optional(std::sqrt(variance))
                                                 : std::nullopt;
}

}  // namespace declutter::accuracy
