#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "modules/geometry/tabletop.h"

namespace declutter {

// z of the surface along a ray of C with z = 1; not finite where the ray misses.
using Surface = std::function<double(const Eigen::Vector3d& ray)>;

inline constexpr double kNoSurface = std::numeric_limits<double>::infinity();
// A camera that looks level: up is against its y.
inline const Eigen::Vector3d kUp_C(0, -1, 0);

inline Surface PlaneSurface(const Eigen::Vector3d& point_C, const Eigen::Vector3d& normal_C) {
  return [=](const Eigen::Vector3d& ray) {
    const double z = point_C.dot(normal_C) / ray.dot(normal_C);
    return z > 0 ? z : kNoSurface;
  };
}

// The outside of an upright cylinder, or with side = +1 the hollow inside of its far half.
inline Surface CylinderSurface(const Eigen::Vector3d& center_C, double radius_m, double side = -1) {
  return [=](const Eigen::Vector3d& ray) {
    const double a = ray.x() * ray.x() + 1;
    const double b = ray.x() * center_C.x() + center_C.z();
    const double c =
        center_C.x() * center_C.x() + center_C.z() * center_C.z() - radius_m * radius_m;
    const double root = b * b - a * c;
    return root < 0 ? kNoSurface : (b + side * std::sqrt(root)) / a;
  };
}

inline Surface NearestOf(const Surface& a, const Surface& b) {
  return [=](const Eigen::Vector3d& ray) { return std::min(a(ray), b(ray)); };
}

// Keeps the pixels where inside(p_C) holds.
inline Surface Clip(const Surface& surface, std::function<bool(const Eigen::Vector3d&)> inside) {
  return [=](const Eigen::Vector3d& ray) {
    const double z = surface(ray);
    return std::isfinite(z) && inside(ray * z) ? z : kNoSurface;
  };
}

// Depth of the surface in steps of 20 um with white noise along z, over a level support 0.3 m below
// the camera.
inline Tabletop Observe(const Surface& surface, double noise_m = 0) {
  Tabletop tabletop;
  tabletop.planes = {{{kUp_C, 0.3}, {}}};
  DepthImage& image = tabletop.objects;
  image.camera = {160, 120, 525, 525, 79.5, 59.5};
  image.depth_scale_m = 2e-5;
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(0, 1);
  for (int v = 0; v < image.camera.height; ++v) {
    for (int u = 0; u < image.camera.width; ++u) {
      const double z = surface(image.camera.Ray(u, v)) + noise_m * noise(generator);
      const bool is_seen = std::isfinite(z) && z > 0 && z < 1.3;
      image.counts.push_back(is_seen ? static_cast<uint16_t>(std::lround(z / 2e-5)) : uint16_t{0});
    }
  }
  return tabletop;
}

}  // namespace declutter
