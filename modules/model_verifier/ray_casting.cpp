#include "modules/model_verifier/ray_casting.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace declutter {
namespace {

// Pixel rectangle, end exclusive.
struct Window {
  int u_begin = 0, u_end = 0, v_begin = 0, v_end = 0;
};

// Around the projection of the solid's bounding box; the whole image when it reaches behind the
// camera.
Window ProjectionWindow(const Solid& solid, const PinholeCamera& camera) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::max());
  Eigen::Vector2d high = -low;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d sign((corner & 1) - 0.5, ((corner >> 1) & 1) - 0.5,
                               ((corner >> 2) & 1) - 0.5);
    const Eigen::Vector3d p_C = solid.X_CO * sign.cwiseProduct(solid.size);
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

}  // namespace

SolidCaster::SolidCaster(const Solid& solid)
    : shape_(solid.shape), half_size_(0.5 * solid.size), X_OC_(solid.X_CO.inverse()) {}

std::optional<Passage> SolidCaster::Cast(const Eigen::Vector3d& ray_C) const {
  const Eigen::Vector3d o = X_OC_.translation();
  const Eigen::Vector3d d = X_OC_.linear() * ray_C;
  double z_in = 0;
  double z_out = std::numeric_limits<double>::max();
  int entry_axis = -1;
  const int first_slab = shape_ == Shape::kBox ? 0 : 2;
  for (int axis = first_slab; axis < 3; ++axis) {
    if (std::abs(d[axis]) < 1e-12) {
      if (std::abs(o[axis]) > half_size_[axis]) return std::nullopt;
      continue;
    }
    const double z0 = (-std::copysign(half_size_[axis], d[axis]) - o[axis]) / d[axis];
    const double z1 = (std::copysign(half_size_[axis], d[axis]) - o[axis]) / d[axis];
    if (z0 > z_in) {
      z_in = z0;
      entry_axis = axis;
    }
    z_out = std::min(z_out, z1);
  }
  if (shape_ == Shape::kCylinder) {
    const double a = d.head<2>().squaredNorm();
    const double b = o.head<2>().dot(d.head<2>());
    const double c = o.head<2>().squaredNorm() - half_size_.x() * half_size_.x();
    if (a < 1e-12) {
      if (c > 0) return std::nullopt;
    } else {
      const double discriminant = b * b - a * c;
      if (discriminant <= 0) return std::nullopt;
      const double root = std::sqrt(discriminant);
      if ((-b - root) / a > z_in) {
        z_in = (-b - root) / a;
        entry_axis = 0;
      }
      z_out = std::min(z_out, (-b + root) / a);
    }
  }
  if (z_in >= z_out || z_in <= 0) return std::nullopt;
  return Passage{z_in, z_out, entry_axis == 2 && d.z() < 0};
}

double SolidCaster::SignedDistance(const Eigen::Vector3d& p_C) const {
  const Eigen::Vector3d p = X_OC_ * p_C;
  if (shape_ == Shape::kBox) {
    const Eigen::Vector3d q = p.cwiseAbs() - half_size_;
    return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
  }
  const Eigen::Vector2d q(p.head<2>().norm() - half_size_.x(), std::abs(p.z()) - half_size_.z());
  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
}

double SurfaceTolerance(double z) { return std::max(0.005, 3 * 0.002 * z * z); }

RayEvidence CastRays(const Solid& solid, const DepthImage& image, const Plane& support) {
  const PinholeCamera& camera = image.camera;
  const SolidCaster caster(solid);
  const Window window = ProjectionWindow(solid, camera);
  RayEvidence evidence;
  for (int v = window.v_begin; v < window.v_end; ++v) {
    for (int u = window.u_begin; u < window.u_end; ++u) {
      const Eigen::Vector3d ray_C = camera.Ray(u, v);
      const std::optional<Passage> passage = caster.Cast(ray_C);
      if (!passage) continue;
      const double z = image.DepthAt(u, v);
      if (z <= 0) {
        ++evidence.num_unknown;
        continue;
      }
      const double tolerance = SurfaceTolerance(z);
      const Eigen::Vector3d p_C = ray_C * z;
      const bool is_on_support = support.Height(p_C) < 0.8 * tolerance;
      const double distance = caster.SignedDistance(p_C);
      if (std::abs(distance) < tolerance && !is_on_support) {
        const double relative = distance / tolerance;
        evidence.explained.push_back({v * camera.width + u,
                                      static_cast<float>(1 - relative * relative),
                                      static_cast<float>(distance)});
      } else if (z < passage->z_in) {
        ++evidence.num_occluded;
      } else if (solid.shape == Shape::kCylinder && passage->through_top && distance < 0) {
        evidence.hollow.push_back(v * camera.width + u);
      } else if (std::min(z, passage->z_out) - passage->z_in > 2 * tolerance) {
        ++evidence.num_violating;
      }
    }
  }
  return evidence;
}

}  // namespace declutter
