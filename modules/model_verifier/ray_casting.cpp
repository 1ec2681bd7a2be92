#include "modules/model_verifier/ray_casting.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "modules/geometry/sensor_noise.h"

namespace declutter {
namespace {

constexpr double kEdgeMargin = 0.012;   // [m] around the edges of a solid normals are blurred
constexpr float kMinNormalCos = 0.85f;  // of a measured normal and the surface's: 32 degrees

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

std::optional<Eigen::Vector3d> SolidCaster::NormalAt(const Eigen::Vector3d& p_C,
                                                     double edge_margin) const {
  const Eigen::Vector3d p = X_OC_ * p_C;
  Eigen::Vector3d n = Eigen::Vector3d::Zero();
  if (shape_ == Shape::kCylinder) {
    const double radial = p.head<2>().norm();
    const double depth_of_side = radial - half_size_.x();
    const double depth_of_end = std::abs(p.z()) - half_size_.z();
    if (std::min(depth_of_side, depth_of_end) > -edge_margin || radial < 1e-9) return std::nullopt;
    if (depth_of_side > depth_of_end) {
      n.head<2>() = p.head<2>() / radial;
    } else {
      n.z() = std::copysign(1.0, p.z());
    }
  } else {
    Eigen::Vector3d q = p.cwiseAbs() - half_size_;
    int face = 0;
    q.maxCoeff(&face);
    n[face] = std::copysign(1.0, p[face]);
    q[face] = std::numeric_limits<double>::lowest();
    if (q.maxCoeff() > -edge_margin) return std::nullopt;
  }
  return X_OC_.linear().transpose() * n;
}

double SurfaceTolerance(double z) { return std::max(0.005, 3 * MeasurementSigma(z)); }

RayEvidence CastRays(const Solid& solid, const DepthImage& image, const NormalImage& normals,
                     const Plane& support) {
  const PinholeCamera& camera = image.camera;
  const SolidCaster caster(solid);
  const PixelWindow window = ProjectionWindow(solid, 0, camera);
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
        const auto n_C = caster.NormalAt(p_C, kEdgeMargin);
        const Eigen::Vector3f& measured = normals.At(u, v);
        float normal_fit = 1;
        if (n_C && !measured.isZero()) {
          normal_fit = (measured.dot(n_C->cast<float>()) - kMinNormalCos) / (1 - kMinNormalCos);
        }
        if (normal_fit < 0) {
          ++evidence.num_contradicting;
          continue;
        }
        const double relative = distance / tolerance;
        evidence.explained.push_back({v * camera.width + u,
                                      normal_fit * static_cast<float>(1 - relative * relative),
                                      static_cast<float>(distance)});
      } else if (z < passage->z_in) {
        ++evidence.num_occluded;
      } else if (solid.shape == Shape::kCylinder && passage->through_top && distance < 0) {
        evidence.hollow.push_back(v * camera.width + u);
      } else if (std::min(z, passage->z_out) - passage->z_in > tolerance) {
        ++evidence.num_violating;
      }
    }
  }
  return evidence;
}

}  // namespace declutter
