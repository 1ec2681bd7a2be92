#include "modules/hough_segmenter/table_points.h"

#include "modules/geometry/sensor_noise.h"

namespace declutter {

void FindTablePoints(const Tabletop& tabletop, const FeatureCloud& features,
                     const Eigen::Isometry3d& X_TC, std::vector<TablePoint>* points) {
  const Eigen::Isometry3f X_TC_f = X_TC.cast<float>();
  const DepthImage& image = tabletop.objects;
  const auto inverse_fx = static_cast<float>(1 / image.camera.fx);
  const auto inverse_fy = static_cast<float>(1 / image.camera.fy);
  const auto cx = static_cast<float>(image.camera.cx);
  const auto cy = static_cast<float>(image.camera.cy);
  const auto scale = static_cast<float>(image.depth_scale_m);
  points->clear();
  points->reserve(features.points.size());
  int v = 0;
  int row = 0;  // the first pixel of v
  for (const FeaturePoint& feature : features.points) {
    if (feature.component < 0 || feature.normal.isZero()) continue;
    for (; feature.pixel >= row + features.width; row += features.width) ++v;
    const int u = feature.pixel - row;
    const float z = scale * static_cast<float>(image.CountAt(u, v));
    if (z <= 0) continue;
    const Eigen::Vector3f p_C(z * inverse_fx * (static_cast<float>(u) - cx),
                              z * inverse_fy * (static_cast<float>(v) - cy), z);
    TablePoint& point = points->emplace_back();
    point.p_T = X_TC_f * p_C;
    point.n_T = X_TC_f.linear() * feature.normal;
    point.sigma = MeasurementSigma(z);
    point.component = feature.component;
    point.kappa = feature.kappa;
    point.curvature = feature.curvature;
    point.r_min = feature.r_min;
    point.u = u;
    point.v = v;
  }
}

}  // namespace declutter
