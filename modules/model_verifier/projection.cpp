#include "modules/model_verifier/projection.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace declutter {

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

RaySolid AsRaySolid(const Solid& solid, const Plane& support) {
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
  const GradientNormals& normals = observation.normals;
  RayWindow window;
  window.ray_x = grid.ray_x.data();
  window.ray_y = grid.ray_y.data();
  window.z = grid.z.data();
  window.stride = grid.stride;
  window.normal_x = normals.x();
  window.normal_y = normals.y();
  window.normal_z = normals.z();
  window.normal_stride = normals.stride();
  window.normal_shift = grid.step == GradientNormals::kStep ? 0 : 1;
  window.columns = grid.columns;
  window.u_begin = observation.First(pixels.u_begin);
  window.u_end = observation.First(pixels.u_end);
  window.v_begin = observation.First(pixels.v_begin);
  window.v_end = observation.First(pixels.v_end);
  return window;
}

}  // namespace declutter
