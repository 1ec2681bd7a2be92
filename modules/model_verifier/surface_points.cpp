#include "modules/model_verifier/surface_points.h"

#include "modules/geometry/sensor_noise.h"
#include "modules/model_verifier/ray_casting.h"

namespace declutter {

std::vector<SurfacePoint> PointsNear(const Solid& solid, double margin_m, const DepthImage& image,
                                     const NormalImage& normals) {
  const PinholeCamera& camera = image.camera;
  const PixelWindow window = ProjectionWindow(solid, margin_m, camera);
  const Eigen::Isometry3d X_OC = solid.X_CO.inverse();
  const Eigen::Vector3d half = 0.5 * solid.size + Eigen::Vector3d::Constant(margin_m);
  std::vector<SurfacePoint> points;
  for (int v = window.v_begin; v < window.v_end; ++v) {
    for (int u = window.u_begin; u < window.u_end; ++u) {
      const double z = image.DepthAt(u, v);
      if (z <= 0) continue;
      const Eigen::Vector3d ray_C = camera.Ray(u, v);
      SurfacePoint point;
      point.p_O = X_OC * (ray_C * z);
      if (((point.p_O.cwiseAbs() - half).array() > 0).any()) continue;
      const double ray_length = ray_C.norm();
      point.ray_O = X_OC.linear() * (ray_C / ray_length);
      point.n_O = X_OC.linear() * normals.At(u, v).cast<double>();
      point.sigma = MeasurementSigma(z) * ray_length;
      point.pixel_area = z * z / (camera.fx * camera.fy) * ray_length;
      points.push_back(point);
    }
  }
  return points;
}

}  // namespace declutter
