#include "modules/hough_segmenter/table_points.h"

#include "modules/geometry/sensor_noise.h"

namespace declutter {

std::vector<TablePoint> TablePoints(const Tabletop& tabletop, const FeatureCloud& features,
                                    const Eigen::Isometry3d& X_TC) {
  const Eigen::Isometry3f X_TC_f = X_TC.cast<float>();
  std::vector<TablePoint> points;
  points.reserve(features.points.size());
  for (const FeaturePoint& feature : features.points) {
    if (feature.component < 0 || feature.normal.isZero()) continue;
    TablePoint point;
    point.u = feature.pixel % features.width;
    point.v = feature.pixel / features.width;
    const Eigen::Vector3f p_C = tabletop.objects.PointAt(point.u, point.v).cast<float>();
    if (p_C.z() <= 0) continue;
    point.p_T = X_TC_f * p_C;
    point.n_T = X_TC_f.linear() * feature.normal;
    point.kappa = feature.kappa;
    point.curvature = feature.curvature;
    point.r_min = feature.r_min;
    point.sigma = MeasurementSigma(p_C.z());
    point.component = feature.component;
    points.push_back(point);
  }
  return points;
}

}  // namespace declutter
