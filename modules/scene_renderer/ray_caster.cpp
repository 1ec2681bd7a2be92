#include "modules/scene_renderer/ray_caster.h"

#include <algorithm>
#include <cmath>

namespace declutter {
namespace {

using Eigen::Vector3d;

// Nearer than this nothing is seen.
constexpr double kMinDepth_m = 1e-3;

struct Hit {
  double z = 0;  // 0: none
  int face = 0;
  double normal_along_ray = 0;  // normal . direction
};

struct PixelRange {
  int u_begin, u_end, v_begin, v_end;
};

// A ray that starts at `start` outside of the solid; a step of 1 along `direction` is 1 m of z in
// C.
Hit HitBox(const Vector3d& half, const Vector3d& start, const Vector3d& direction) {
  double enter = kMinDepth_m, leave = 1e9;
  int axis_entered = -1;
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0) {
      if (std::abs(start[axis]) > half[axis]) return {};
      continue;
    }
    const double inverse = 1 / direction[axis];
    const double middle = -start[axis] * inverse;
    const double reach = half[axis] * std::abs(inverse);
    if (middle - reach > enter) {
      enter = middle - reach;
      axis_entered = axis;
    }
    leave = std::min(leave, middle + reach);
  }
  if (axis_entered < 0 || enter > leave) return {};
  const bool positive_side = direction[axis_entered] < 0;
  return {enter, 2 * axis_entered + (positive_side ? 1 : 0), -std::abs(direction[axis_entered])};
}

Hit HitCylinder(const Vector3d& half, const Vector3d& start, const Vector3d& direction) {
  const double r2 = half.x() * half.x();
  if (direction.z() != 0) {
    const double side = direction.z() < 0 ? 1 : -1;
    const double step = (side * half.z() - start.z()) / direction.z();
    const double x = start.x() + step * direction.x(), y = start.y() + step * direction.y();
    if (step > kMinDepth_m && x * x + y * y <= r2) {
      return {step, side > 0 ? 5 : 4, -std::abs(direction.z())};
    }
  }
  const double a = direction.head<2>().squaredNorm();
  const double b = start.head<2>().dot(direction.head<2>());
  const double discriminant = b * b - a * (start.head<2>().squaredNorm() - r2);
  if (a == 0 || discriminant < 0) return {};
  const double step = (-b - std::sqrt(discriminant)) / a;
  if (step <= kMinDepth_m || std::abs(start.z() + step * direction.z()) > half.z()) return {};
  return {step, 0, -std::sqrt(discriminant) / half.x()};
}

// Pixels that may see the solid: all of them when a corner of its bounds is behind the camera.
PixelRange Bounds(const PinholeCamera& camera, const Solid& solid) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e9), high = -low;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d sign((corner & 1) ? 0.5 : -0.5, (corner & 2) ? 0.5 : -0.5,
                        (corner & 4) ? 0.5 : -0.5);
    const Vector3d p_C = solid.X_CO * sign.cwiseProduct(solid.size);
    if (p_C.z() < 0.01) return {0, camera.width, 0, camera.height};
    low = low.cwiseMin(camera.Project(p_C));
    high = high.cwiseMax(camera.Project(p_C));
  }
  const auto clip = [](double x, int limit) {
    return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(limit)));
  };
  return {clip(std::floor(low.x()), camera.width), clip(std::ceil(high.x()) + 1, camera.width),
          clip(std::floor(low.y()), camera.height), clip(std::ceil(high.y()) + 1, camera.height)};
}

void CastRaysAt(const Solid& solid, int16_t index, IdealImage* image) {
  const PinholeCamera& camera = image->camera;
  const Eigen::Isometry3d X_OC = solid.X_CO.inverse();
  const Vector3d half = 0.5 * solid.size;
  const Vector3d start = X_OC.translation();
  const PixelRange range = Bounds(camera, solid);
  for (int v = range.v_begin; v < range.v_end; ++v) {
    for (int u = range.u_begin; u < range.u_end; ++u) {
      const Vector3d ray = camera.Ray(u, v);
      const Vector3d direction = X_OC.linear() * ray;
      const Hit hit = solid.shape == Shape::kBox ? HitBox(half, start, direction)
                                                 : HitCylinder(half, start, direction);
      if (hit.z == 0) continue;
      ++image->num_covered[static_cast<size_t>(index)];
      const size_t pixel =
          static_cast<size_t>(v) * static_cast<size_t>(camera.width) + static_cast<size_t>(u);
      const float z = static_cast<float>(hit.z);
      if (image->solid[pixel] >= 0 && image->z[pixel] <= z) continue;
      image->z[pixel] = z;
      image->solid[pixel] = index;
      image->face[pixel] = static_cast<uint8_t>(hit.face);
      image->incidence[pixel] = static_cast<float>(-hit.normal_along_ray / ray.norm());
    }
  }
}

}  // namespace

IdealImage CastRays(const PinholeCamera& camera, const std::vector<Solid>& solids) {
  const size_t num_pixels = static_cast<size_t>(camera.num_pixels());
  IdealImage image;
  image.camera = camera;
  image.z.assign(num_pixels, 0);
  image.solid.assign(num_pixels, -1);
  image.face.assign(num_pixels, 0);
  image.incidence.assign(num_pixels, 0);
  image.num_covered.assign(solids.size(), 0);
  for (size_t i = 0; i < solids.size(); ++i) CastRaysAt(solids[i], static_cast<int16_t>(i), &image);
  return image;
}

}  // namespace declutter
