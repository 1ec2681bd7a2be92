#include "modules/feature_estimator/horizontal_curvature.h"

#include <cmath>

#include "modules/feature_estimator/lanes.h"

namespace declutter {
namespace {

// Neighbouring pixels share their noise, so a window this wide need not be read densely.
constexpr int kRowsReadDensely = 10;

// Points, normals and horizontal tangents of the points on sides; kFar and zero elsewhere.
struct SideImage {
  PointImage points;
  std::vector<float> normal_x, normal_y, normal_z;
  std::vector<float> tangent_x, tangent_y, tangent_z;
};

SideImage SelectSides(const PointImage& points, const NormalImage& normals,
                      const Eigen::Vector3f& up_C, double max_tilt_rad) {
  SideImage sides{points, normals.x, normals.y, normals.z, {}, {}, {}};
  for (auto* plane : {&sides.tangent_x, &sides.tangent_y, &sides.tangent_z}) {
    plane->assign(points.x.size(), 0.0F);
  }
  const float max_vertical = static_cast<float>(std::sin(max_tilt_rad));
  for (size_t i = 0; i < points.x.size(); ++i) {
    const Eigen::Vector3f normal(normals.x[i], normals.y[i], normals.z[i]);
    if (normals.IsKnown(i) && std::abs(normal.dot(up_C)) <= max_vertical) {
      const Eigen::Vector3f tangent = up_C.cross(normal).normalized();
      sides.tangent_x[i] = tangent.x();
      sides.tangent_y[i] = tangent.y();
      sides.tangent_z[i] = tangent.z();
    } else {
      sides.points.x[i] = sides.points.y[i] = sides.points.z[i] = PointImage::kFar;
    }
  }
  return sides;
}

DECLUTTER_FOR_EACH_PROCESSOR void FitBlock(const SideImage& sides, size_t begin, float radius_m,
                                           std::vector<float>* kappa) {
  const PointImage& points = sides.points;
  const SphereWindow window(points, begin, radius_m);
  const int step = 1 + window.num_rows() / kRowsReadDensely;
  const float max_squared_distance = radius_m * radius_m;
  Lanes px, py, pz, tx, ty, tz;
  LoadLanes(&points.x[begin], px);
  LoadLanes(&points.y[begin], py);
  LoadLanes(&points.z[begin], pz);
  LoadLanes(&sides.tangent_x[begin], tx);
  LoadLanes(&sides.tangent_y[begin], ty);
  LoadLanes(&sides.tangent_z[begin], tz);
  Lanes sum_s{}, sum_m{}, sum_ss{}, sum_ms{};
  LaneMask n{};
  for (int row = -window.num_rows() / step * step; row <= window.num_rows(); row += step) {
    const int columns = window.Columns(row);
    const ptrdiff_t center = static_cast<ptrdiff_t>(begin) + row * points.stride;
    for (int column = -columns / step * step; column <= columns; column += step) {
      const ptrdiff_t q = center + column;
      Lanes x, y, z, nx, ny, nz;
      LoadLanes(points.x.data() + q, x);
      LoadLanes(points.y.data() + q, y);
      LoadLanes(points.z.data() + q, z);
      LoadLanes(sides.normal_x.data() + q, nx);
      LoadLanes(sides.normal_y.data() + q, ny);
      LoadLanes(sides.normal_z.data() + q, nz);
      x -= px;
      y -= py;
      z -= pz;
      const LaneMask near = x * x + y * y + z * z <= max_squared_distance;
      Lanes s = x * tx + y * ty + z * tz;
      Lanes m = nx * tx + ny * ty + nz * tz;
      KeepLanes(near, s);
      KeepLanes(near, m);
      n -= near;
      sum_s += s;
      sum_m += m;
      sum_ss += s * s;
      sum_ms += m * s;
    }
  }
  const Lanes count = n > 0 ? __builtin_convertvector(n, Lanes) : 1.0F + Lanes{};
  const Lanes covariance = sum_ms - sum_m * sum_s / count;
  const Lanes variance = sum_ss - sum_s * sum_s / count;
  Lanes slope = variance > 1e-9F ? covariance / variance : Lanes{};
  KeepLanes(pz < PointImage::kFar, slope);
  StoreLanes(slope, &(*kappa)[begin]);
}

}  // namespace

std::vector<float> EstimateHorizontalCurvature(const PointImage& points, const NormalImage& normals,
                                               const Eigen::Vector3d& up_C, double radius_m,
                                               double max_tilt_rad) {
  const SideImage sides = SelectSides(points, normals, up_C.cast<float>(), max_tilt_rad);
  std::vector<float> kappa(points.x.size(), 0.0F);
  for (int j = 0; j < points.height; ++j) {
    for (int i = 0; i < points.width; ++i) {
      const size_t begin = points.Index(i, j);
      if (!sides.points.HasPoint(begin)) continue;
      FitBlock(sides, begin, static_cast<float>(radius_m), &kappa);
      i += PointImage::kLanes - 1;
    }
  }
  return kappa;
}

}  // namespace declutter
