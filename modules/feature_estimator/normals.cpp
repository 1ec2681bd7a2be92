#include "modules/feature_estimator/normals.h"

#include <cmath>
#include <utility>

#include "modules/feature_estimator/lanes.h"
#include "modules/feature_estimator/row_sharing.h"
#include "modules/feature_estimator/sphere_window.h"

namespace declutter {
namespace {

// Fewer do not span a plane.
constexpr float kMinSamples = 3;

// Sums over the neighbours q of p, of e = q - p: stays small, so float is enough.
struct Moments {
  Lanes n{}, x{}, y{}, z{}, xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
};

DECLUTTER_LANES void SumMoments(const PointImage& points, size_t begin,
                                const Neighborhood& neighborhood, Moments& sums,
                                Lanes& num_points) {
  const SphereWindow window(points, begin, neighborhood);
  const int stride = window.stride();
  const float radius_m = static_cast<float>(neighborhood.radius_m);
  Lanes px, py, pz;
  LoadLanes(&points.x[begin], px);
  LoadLanes(&points.y[begin], py);
  LoadLanes(&points.z[begin], pz);
  const float max_squared_distance = radius_m * radius_m;
  LaneMask n{};
  Moments s;
  for (int step = -window.num_steps(); step <= window.num_steps(); ++step) {
    const int columns = window.Columns(step);
    const ptrdiff_t center = static_cast<ptrdiff_t>(begin) + step * stride * points.stride;
    const float* qx = points.x.data() + center;
    const float* qy = points.y.data() + center;
    const float* qz = points.z.data() + center;
    for (int column = -columns; column <= columns; column += stride) {
      Lanes x, y, z;
      LoadLanes(qx + column, x);
      LoadLanes(qy + column, y);
      LoadLanes(qz + column, z);
      x -= px;
      y -= py;
      z -= pz;
      const LaneMask near = x * x + y * y + z * z <= max_squared_distance;
      KeepLanes(near, x);
      KeepLanes(near, y);
      KeepLanes(near, z);
      n -= near;
      s.x += x;
      s.y += y;
      s.z += z;
      s.xx += x * x;
      s.xy += x * y;
      s.xz += x * z;
      s.yy += y * y;
      s.yz += y * z;
      s.zz += z * z;
    }
  }
  s.n = __builtin_convertvector(n, Lanes);
  sums = s;
  num_points = s.n * static_cast<float>(stride * stride);
}

// Covariance with trace 1 in place of the sums; empty neighbourhoods become zero.
DECLUTTER_LANES void NormalizedCovariance(const Moments& s, Moments& c) {
  const Lanes n = s.n > 0 ? s.n : 1.0F + Lanes{};
  c.xx = s.xx - s.x * s.x / n;
  c.xy = s.xy - s.x * s.y / n;
  c.xz = s.xz - s.x * s.z / n;
  c.yy = s.yy - s.y * s.y / n;
  c.yz = s.yz - s.y * s.z / n;
  c.zz = s.zz - s.z * s.z / n;
  const Lanes trace = c.xx + c.yy + c.zz;
  const Lanes scale = trace > 0 ? 1.0F / trace : Lanes{};
  c.xx *= scale;
  c.xy *= scale;
  c.xz *= scale;
  c.yy *= scale;
  c.yz *= scale;
  c.zz *= scale;
}

// Newton's iteration from zero climbs to the smallest root of the characteristic polynomial
// l^3 - l^2 + c1 l - c0 without passing it.
DECLUTTER_LANES void SmallestEigenvalue(const Moments& c, Lanes& lambda) {
  const Lanes minor_x = c.yy * c.zz - c.yz * c.yz;
  const Lanes c1 = minor_x + (c.xx * c.zz - c.xz * c.xz) + (c.xx * c.yy - c.xy * c.xy);
  const Lanes c0 =
      c.xx * minor_x + c.xy * (c.xz * c.yz - c.xy * c.zz) + c.xz * (c.xy * c.yz - c.yy * c.xz);
  lambda = Lanes{};
  for (int step = 0; step < 8; ++step) {
    const Lanes value = ((lambda - 1.0F) * lambda + c1) * lambda - c0;
    const Lanes slope = (3.0F * lambda - 2.0F) * lambda + c1;
    lambda -= slope > 1e-9F ? value / slope : Lanes{};
  }
  lambda = lambda > 0 ? lambda : Lanes{};
}

// The eigenvector is normal to the rows of C - lambda I: the longest of their cross products.
DECLUTTER_LANES void Eigenvector(const Moments& c, const Lanes& lambda, Lanes& x, Lanes& y,
                                 Lanes& z) {
  const Lanes xx = c.xx - lambda, yy = c.yy - lambda, zz = c.zz - lambda;
  x = c.xy * c.yz - c.xz * yy;
  y = c.xz * c.xy - xx * c.yz;
  z = xx * yy - c.xy * c.xy;
  Lanes squared_norm = x * x + y * y + z * z;
  const auto keep_longer = [&](const Lanes& ax, const Lanes& ay, const Lanes& az) {
    const Lanes a = ax * ax + ay * ay + az * az;
    const LaneMask longer = a > squared_norm;
    x = longer ? ax : x;
    y = longer ? ay : y;
    z = longer ? az : z;
    squared_norm = longer ? a : squared_norm;
  };
  keep_longer(c.xy * zz - c.xz * c.yz, c.xz * c.xz - xx * zz, xx * c.yz - c.xy * c.xz);
  keep_longer(yy * zz - c.yz * c.yz, c.yz * c.xz - c.xy * zz, c.xy * c.yz - yy * c.xz);
  float norm[PointImage::kLanes];
  StoreLanes(squared_norm, norm);
  for (float& value : norm) value = std::sqrt(value);
  Lanes length;
  LoadLanes(norm, length);
  const Lanes scale = length > 1e-9F ? 1.0F / length : Lanes{};
  x *= scale;
  y *= scale;
  z *= scale;
}

DECLUTTER_FOR_EACH_PROCESSOR void EstimateBlock(const PointImage& points, size_t begin,
                                                const Neighborhood& neighborhood, int min_neighbors,
                                                NormalImage* normals) {
  Moments sums, covariance;
  Lanes num_points;
  SumMoments(points, begin, neighborhood, sums, num_points);
  NormalizedCovariance(sums, covariance);
  Lanes lambda, x, y, z, px, py, pz;
  SmallestEigenvalue(covariance, lambda);
  Eigenvector(covariance, lambda, x, y, z);
  LoadLanes(&points.x[begin], px);
  LoadLanes(&points.y[begin], py);
  LoadLanes(&points.z[begin], pz);
  const Lanes toward = x * px + y * py + z * pz > 0 ? -1.0F + Lanes{} : 1.0F + Lanes{};
  x *= toward;
  y *= toward;
  z *= toward;
  const LaneMask known = (pz < PointImage::kFar) &
                         (num_points >= static_cast<float>(min_neighbors)) &
                         (sums.n >= kMinSamples);
  KeepLanes(known, x);
  KeepLanes(known, y);
  KeepLanes(known, z);
  KeepLanes(known, lambda);
  StoreLanes(x, &normals->x[begin]);
  StoreLanes(y, &normals->y[begin]);
  StoreLanes(z, &normals->z[begin]);
  StoreLanes(lambda, &normals->curvature[begin]);
}

}  // namespace

NormalImage EstimateNormals(const PointImage& points, const Neighborhood& neighborhood,
                            int min_neighbors, NormalImage recycled) {
  NormalImage normals = std::move(recycled);
  for (auto* plane : {&normals.x, &normals.y, &normals.z, &normals.curvature}) {
    plane->assign(points.x.size(), 0.0F);
  }
  for (int j = 0; j < points.height; ++j) {
    for (int i = 0; i < points.width; ++i) {
      const size_t begin = points.Index(i, j);
      if (!points.HasPoint(begin)) continue;
      const bool is_taken =
          j % 2 == 1 && TakeRowAbove(points, points.x.data(), begin, neighborhood,
                                     {&normals.x, &normals.y, &normals.z, &normals.curvature});
      if (!is_taken) EstimateBlock(points, begin, neighborhood, min_neighbors, &normals);
      i += PointImage::kLanes - 1;
    }
  }
  return normals;
}

}  // namespace declutter
