#include "modules/model_verifier/surface_points.h"

#include "modules/geometry/sensor_noise.h"
#include "modules/model_verifier/ray_casting.h"

namespace declutter {

std::vector<SurfacePoint> PointsNear(const Solid& solid, double margin_m,
                                     const Observation& observation) {
  const PinholeCamera& camera = observation.image.camera;
  const PixelWindow window = ProjectionWindow(solid, margin_m, camera);
  const int step = observation.grid.step;
  const Eigen::Isometry3d X_OC = solid.X_CO.inverse();
  const Eigen::Vector3d half = 0.5 * solid.size + Eigen::Vector3d::Constant(margin_m);
  std::vector<SurfacePoint> points;
  for (int v = step * observation.First(window.v_begin); v < window.v_end; v += step) {
    for (int u = step * observation.First(window.u_begin); u < window.u_end; u += step) {
      const double z = observation.image.DepthAt(u, v);
      if (z <= 0) continue;
      const Eigen::Vector3d ray_C = camera.Ray(u, v);
      const Eigen::Vector3d p_O = X_OC * (ray_C * z);
      if (((p_O.cwiseAbs() - half).array() > 0).any()) continue;
      const double ray_length = ray_C.norm();
      SurfacePoint& point = points.emplace_back();
      point.p_O = p_O;
      point.ray_O = X_OC.linear() * (ray_C / ray_length);
      point.n_O = X_OC.linear() * observation.normals.At(u, v).cast<double>();
      point.sigma = MeasurementSigma(z) * ray_length;
      point.num_px = observation.grid.pixel_weight();
      point.pixel_area = point.num_px * z * z / (camera.fx * camera.fy) * ray_length;
    }
  }
  return points;
}

}  // namespace declutter
