#include "modules/feature_estimator/horizontal_curvature.h"

#include <cmath>
#include <utility>

#include "modules/feature_estimator/lanes.h"
#include "modules/feature_estimator/row_sharing.h"
#include "modules/feature_estimator/sphere_window.h"

namespace declutter {
namespace {

// Part of the neighbours that half of a window must hold to be trusted.
constexpr float kMinHalf = 0.125F;

// The points, of which those on sides, their normals and tangents.
struct SideImage {
  const PointImage& points;
  const NormalImage& normals;
  CurvatureImage& curvature;
};

// Of elements [begin, begin + num). Where the normal is unknown or vertical, tangents mean nothing.
DECLUTTER_FOR_EACH_PROCESSOR void SelectSidesOfRow(const SideImage& sides, size_t begin, size_t num,
                                                   const float* up_C, float max_vertical) {
  const float* const x = &sides.points.x[begin];
  const float* const nx = &sides.normals.x[begin];
  const float* const ny = &sides.normals.y[begin];
  const float* const nz = &sides.normals.z[begin];
  float* const side_x = &sides.curvature.side_x[begin];
  float* const tangent_x = &sides.curvature.tangent_x[begin];
  float* const tangent_y = &sides.curvature.tangent_y[begin];
  float* const tangent_z = &sides.curvature.tangent_z[begin];
  const float ux = up_C[0], uy = up_C[1], uz = up_C[2], far = PointImage::kFar;
#pragma GCC ivdep
  for (size_t i = 0; i < num; ++i) {
    const float px = x[i];
    const float vertical = std::abs(nx[i] * ux + (ny[i] * uy + nz[i] * uz));
    const float tx = uy * nz[i] - uz * ny[i];
    const float ty = uz * nx[i] - ux * nz[i];
    const float tz = ux * ny[i] - uy * nx[i];
    const float norm = std::sqrt(tx * tx + (ty * ty + tz * tz));
    tangent_x[i] = tx / norm;
    tangent_y[i] = ty / norm;
    tangent_z[i] = tz / norm;
    // The norm of an unknown normal's tangent is 0.
    side_x[i] = (vertical <= max_vertical) & (norm > 0) ? px : far;
  }
}

void SelectSides(const Eigen::Vector3f& up_C, double max_tilt_rad, SideImage* sides) {
  const PointImage& points = sides->points;
  CurvatureImage& curvature = sides->curvature;
  curvature.side_x.assign(points.x.size(), PointImage::kFar);
  for (auto* plane : {&curvature.tangent_x, &curvature.tangent_y, &curvature.tangent_z}) {
    plane->resize(points.x.size());
  }
  const float max_vertical = static_cast<float>(std::sin(max_tilt_rad));
  for (int j = 0; j < points.height; ++j) {
    SelectSidesOfRow(*sides, points.Index(0, j), static_cast<size_t>(points.width), up_C.data(),
                     max_vertical);
  }
}

// Sums over neighbours at offset s along the tangent whose normals have component m along it.
struct SlopeSums {
  Lanes n{}, s{}, m{}, ss{}, sm{};

  DECLUTTER_LANES void Add(const Lanes& weight, const Lanes& offset, const Lanes& component) {
    n += weight;
    s += offset;
    m += component;
    ss += offset * offset;
    sm += offset * component;
  }
};

// Centred regression: an error of the normal at the point itself shifts all m alike.
DECLUTTER_LANES void FitSlope(const SlopeSums& sums, Lanes& slope) {
  const Lanes n = sums.n > 0 ? sums.n : 1.0F + Lanes{};
  const Lanes variance = sums.ss - sums.s * sums.s / n;
  slope = variance > 1e-9F ? (sums.sm - sums.s * sums.m / n) / variance : Lanes{};
}

// Mean squared distance of all m from their line.
DECLUTTER_LANES void SquaredResidual(const SlopeSums& sums, const Lanes& mm, const Lanes& slope,
                                     Lanes& residual) {
  const Lanes n = sums.n > 0 ? sums.n : 1.0F + Lanes{};
  residual = (mm - sums.m * sums.m / n - slope * (sums.sm - sums.s * sums.m / n)) / n;
}

// Over a vertical edge m is no line but a step. The half of the window on the point's own face is
// then the one that bends less; a half with too few points says nothing.
DECLUTTER_LANES void FitFlatterHalf(const SlopeSums& all, const SlopeSums& left, Lanes& slope) {
  SlopeSums right;
  right.n = all.n - left.n;
  right.s = all.s - left.s;
  right.m = all.m - left.m;
  right.ss = all.ss - left.ss;
  right.sm = all.sm - left.sm;
  Lanes a, b;
  FitSlope(left, a);
  FitSlope(right, b);
  const LaneMask is_left_thin = kMinHalf * all.n > left.n;
  const LaneMask is_right_thin = kMinHalf * all.n > right.n;
  const LaneMask is_left_flatter = a * a < b * b;
  slope = ((is_left_flatter | is_right_thin) & ~is_left_thin) ? a : b;
}

DECLUTTER_LANES void SumNeighbors(const SideImage& sides, size_t begin,
                                  const Neighborhood& neighborhood, SlopeSums& all, SlopeSums& left,
                                  Lanes& mm) {
  const PointImage& points = sides.points;
  const NormalImage& normals = sides.normals;
  const CurvatureImage& curvature = sides.curvature;
  const SphereWindow window(points, curvature.side_x.data(), begin, neighborhood);
  const int stride = window.stride();
  const float radius_m = static_cast<float>(neighborhood.radius_m);
  const float max_squared_distance = radius_m * radius_m;
  Lanes px, py, pz, tx, ty, tz;
  LoadLanes(&curvature.side_x[begin], px);
  LoadLanes(&points.y[begin], py);
  LoadLanes(&points.z[begin], pz);
  LoadLanes(&curvature.tangent_x[begin], tx);
  LoadLanes(&curvature.tangent_y[begin], ty);
  LoadLanes(&curvature.tangent_z[begin], tz);
  for (int step = -window.num_steps(); step <= window.num_steps(); ++step) {
    const int columns = window.Columns(step);
    const ptrdiff_t center = static_cast<ptrdiff_t>(begin) + step * stride * points.stride;
    for (int column = -columns; column <= columns; column += stride) {
      const ptrdiff_t q = center + column;
      Lanes x, y, z, nx, ny, nz;
      LoadLanes(curvature.side_x.data() + q, x);
      LoadLanes(points.y.data() + q, y);
      LoadLanes(points.z.data() + q, z);
      LoadLanes(normals.x.data() + q, nx);
      LoadLanes(normals.y.data() + q, ny);
      LoadLanes(normals.z.data() + q, nz);
      x -= px;
      y -= py;
      z -= pz;
      const LaneMask near = x * x + y * y + z * z <= max_squared_distance;
      Lanes weight = 1.0F + Lanes{};
      Lanes s = x * tx + y * ty + z * tz;
      Lanes m = nx * tx + ny * ty + nz * tz;
      KeepLanes(near, weight);
      KeepLanes(near, s);
      KeepLanes(near, m);
      all.Add(weight, s, m);
      mm += m * m;
      const LaneMask is_left = s < 0;
      KeepLanes(is_left, weight);
      KeepLanes(is_left, s);
      KeepLanes(is_left, m);
      left.Add(weight, s, m);
    }
  }
}

DECLUTTER_FOR_EACH_PROCESSOR void FitBlock(const SideImage& sides, size_t begin,
                                           const CurvatureWindow& window) {
  SlopeSums all, left;
  Lanes mm{}, slope, half_slope, residual, px;
  SumNeighbors(sides, begin, window.neighborhood, all, left, mm);
  FitSlope(all, slope);
  SquaredResidual(all, mm, slope, residual);
  FitFlatterHalf(all, left, half_slope);
  const float max_residual = static_cast<float>(window.max_residual);
  slope = residual > max_residual * max_residual ? half_slope : slope;
  LoadLanes(&sides.curvature.side_x[begin], px);
  KeepLanes(px < PointImage::kFar, slope);
  StoreLanes(slope, &sides.curvature.kappa[begin]);
}

}  // namespace

CurvatureImage EstimateHorizontalCurvature(const PointImage& points, const NormalImage& normals,
                                           const Eigen::Vector3d& up_C,
                                           const CurvatureWindow& window, CurvatureImage recycled) {
  CurvatureImage curvature = std::move(recycled);
  curvature.kappa.assign(points.x.size(), 0.0F);
  SideImage sides{points, normals, curvature};
  SelectSides(up_C.cast<float>(), window.max_tilt_rad, &sides);
  for (int j = 0; j < points.height; ++j) {
    for (int i = 0; i < points.width; ++i) {
      const size_t begin = points.Index(i, j);
      if (curvature.side_x[begin] >= PointImage::kFar) continue;
      const bool is_taken = j % 2 == 1 && TakeRowAbove(points, curvature.side_x.data(), begin,
                                                       window.neighborhood, {&curvature.kappa});
      if (!is_taken) FitBlock(sides, begin, window);
      i += PointImage::kLanes - 1;
    }
  }
  return curvature;
}

}  // namespace declutter
