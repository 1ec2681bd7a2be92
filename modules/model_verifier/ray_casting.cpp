#include "modules/model_verifier/ray_casting.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "modules/geometry/sensor_noise.h"

namespace declutter {
namespace {

constexpr double kEdgeMargin = 0.012;    // [m] around the edges of a solid normals are blurred
constexpr double kMaxOverhang = 0.015;   // [m] beside a solid that its top face is looked for
constexpr double kTopTolerance = 0.004;  // [m] in height of points on one top face
constexpr float kMinNormalCos = 0.85f;   // of a measured normal and the surface's: 32 degrees

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
    : shape_(solid.shape),
      half_size_(0.5 * solid.size),
      X_OC_(solid.X_CO.inverse()),
      camera_O_(X_OC_.translation()) {}

std::optional<Passage> SolidCaster::Cast(const Eigen::Vector3d& d) const {
  const Eigen::Vector3d& o = camera_O_;
  double z_in = 0;
  double z_out = std::numeric_limits<double>::max();
  int entry_axis = -1;
  const int first_slab = shape_ == Shape::kBox ? 0 : 2;
  for (int axis = 2; axis >= first_slab; --axis) {
    if (std::abs(d[axis]) < 1e-12) {
      if (std::abs(o[axis]) > half_size_[axis]) return std::nullopt;
      continue;
    }
    const double inverse = 1 / d[axis];
    const double middle = -o[axis] * inverse;
    const double half = std::abs(half_size_[axis] * inverse);
    if (middle - half > z_in) {
      z_in = middle - half;
      entry_axis = axis;
    }
    z_out = std::min(z_out, middle + half);
    if (z_in >= z_out) return std::nullopt;
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

double SolidCaster::SignedDistance(const Eigen::Vector3d& p) const {
  if (shape_ == Shape::kBox) {
    const Eigen::Vector3d q = p.cwiseAbs() - half_size_;
    return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
  }
  const Eigen::Vector2d q(p.head<2>().norm() - half_size_.x(), std::abs(p.z()) - half_size_.z());
  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
}

std::optional<double> SolidCaster::OverhangOf(const Eigen::Vector3d& p, double tolerance) const {
  if (std::abs(p.z() - half_size_.z()) > tolerance) return std::nullopt;
  if (shape_ == Shape::kCylinder) return p.head<2>().norm() - half_size_.x();
  return (p.cwiseAbs() - half_size_).head<2>().maxCoeff();
}

std::optional<Eigen::Vector3d> SolidCaster::NormalAt(const Eigen::Vector3d& p,
                                                     double edge_margin) const {
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
    return n;
  }
  Eigen::Vector3d q = p.cwiseAbs() - half_size_;
  int face = 0;
  q.maxCoeff(&face);
  n[face] = std::copysign(1.0, p[face]);
  q[face] = std::numeric_limits<double>::lowest();
  if (q.maxCoeff() > -edge_margin) return std::nullopt;
  return n;
}

namespace {

// Sorts the observed pixels into what they say of one solid.
class RayCast {
 public:
  RayCast(const Solid& solid, const Observation& observation)
      : solid_(solid),
        observation_(observation),
        caster_(solid),
        support_normal_O_(caster_.X_OC().linear() * observation.support.normal),
        camera_height_(observation.support.Height(Eigen::Vector3d::Zero())) {
    evidence_.pixel_weight = observation.pixel_weight();
  }

  RayEvidence Run() {
    const PinholeCamera& camera = observation_.image.camera;
    const PixelWindow window = ProjectionWindow(solid_, kMaxOverhang, camera);
    const int step = observation_.step;
    const Eigen::Vector3d right_O = caster_.X_OC().linear().col(0) / camera.fx;
    for (int v = observation_.First(window.v_begin); v < window.v_end; v += step) {
      const Eigen::Vector3d left_O = caster_.X_OC().linear() * camera.Ray(0, v);
      for (int u = observation_.First(window.u_begin); u < window.u_end; u += step) {
        See(u, v, left_O + u * right_O);
      }
    }
    return std::move(evidence_);
  }

 private:
  void See(int u, int v, const Eigen::Vector3d& ray_O) {
    const std::optional<Passage> passage = caster_.Cast(ray_O);
    const double z = observation_.image.DepthAt(u, v);
    if (!passage) {
      if (z > 0 && Overhangs(u, v, z, ray_O)) {
        evidence_.num_overhanging += evidence_.pixel_weight;
      }
      return;
    }
    if (z <= 0) {
      evidence_.num_unknown += evidence_.pixel_weight;
      return;
    }
    const double tolerance = SurfaceTolerance(z);
    const Eigen::Vector3d p_O = caster_.X_OC().translation() + z * ray_O;
    const double distance = caster_.SignedDistance(p_O);
    if (std::abs(distance) < tolerance && Height(z, ray_O) >= 0.8 * tolerance) {
      Explain(u, v, p_O, distance / tolerance, distance);
    } else if (z < passage->z_in) {
      evidence_.num_occluded += evidence_.pixel_weight;
    } else if (solid_.shape == Shape::kCylinder && passage->through_top && distance < 0) {
      evidence_.hollow.push_back(v * observation_.image.camera.width + u);
    } else if (std::min(z, passage->z_out) - passage->z_in > tolerance) {
      evidence_.num_violating += evidence_.pixel_weight;
    }
  }

  void Explain(int u, int v, const Eigen::Vector3d& p_O, double relative, double distance) {
    const auto n_O = caster_.NormalAt(p_O, kEdgeMargin);
    const Eigen::Vector3f& measured = observation_.normals.At(u, v);
    float normal_fit = 1;
    if (n_O && !measured.isZero()) {
      const Eigen::Vector3d n_C = caster_.X_OC().linear().transpose() * *n_O;
      normal_fit = (measured.dot(n_C.cast<float>()) - kMinNormalCos) / (1 - kMinNormalCos);
    }
    if (normal_fit < 0) {
      evidence_.num_contradicting += evidence_.pixel_weight;
      return;
    }
    evidence_.explained.push_back({v * observation_.image.camera.width + u,
                                   normal_fit * static_cast<float>(1 - relative * relative),
                                   static_cast<float>(distance)});
  }

  // The side of something that stands in front is no part of the top face.
  bool Overhangs(int u, int v, double z, const Eigen::Vector3d& ray_O) const {
    const Eigen::Vector3d p_O = caster_.X_OC().translation() + z * ray_O;
    const auto overhang = caster_.OverhangOf(p_O, kTopTolerance);
    if (!overhang || *overhang < 0 || *overhang > kMaxOverhang ||
        Height(z, ray_O) < SurfaceTolerance(z)) {
      return false;
    }
    const Eigen::Vector3f& n_C = observation_.normals.At(u, v);
    return n_C.isZero() || (caster_.X_OC().linear() * n_C.cast<double>()).z() > kMinNormalCos;
  }

  // [m] above the support plane.
  double Height(double z, const Eigen::Vector3d& ray_O) const {
    return camera_height_ + z * support_normal_O_.dot(ray_O);
  }

  const Solid& solid_;
  const Observation& observation_;
  SolidCaster caster_;
  Eigen::Vector3d support_normal_O_;
  double camera_height_;
  RayEvidence evidence_;
};

}  // namespace

double RayEvidence::Balance() const {
  double fit = 0;
  for (const ExplainedPixel& pixel : explained) fit += pixel.fit;
  return pixel_weight * fit - num_violating - num_contradicting - num_overhanging;
}

double SurfaceTolerance(double z) { return std::max(0.005, 3 * MeasurementSigma(z)); }

RayEvidence CastRays(const Solid& solid, const Observation& observation) {
  return RayCast(solid, observation).Run();
}

}  // namespace declutter
