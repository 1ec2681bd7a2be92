#include "modules/feature_estimator/feature_estimator.h"

#include <algorithm>

#include "modules/feature_estimator/components.h"
#include "modules/feature_estimator/horizontal_curvature.h"
#include "modules/feature_estimator/normals.h"
#include "modules/feature_estimator/point_image.h"
#include "modules/feature_estimator/rsd.h"

namespace declutter {

FeatureEstimator::FeatureEstimator(const FeatureEstimatorConfig& config) : config_(config) {}

FeatureCloud FeatureEstimator::Estimate(const Tabletop& tabletop) const {
  FeatureCloud cloud;
  cloud.header = tabletop.header;
  cloud.mode = config_.mode() == "paper" ? FeatureMode::kPaper : FeatureMode::kDefault;
  cloud.width = tabletop.objects.camera.width;
  cloud.height = tabletop.objects.camera.height;
  cloud.thinning = tabletop.thinning;
  if (tabletop.planes.empty()) return cloud;

  const bool is_paper = cloud.mode == FeatureMode::kPaper;
  const double normal_radius_m =
      is_paper ? config_.paper_normal_radius_m() : config_.normal_radius_m();
  const int dense_px = is_paper ? Neighborhood::kReadAll : config_.dense_window_px();
  const double feature_radius_m = is_paper ? config_.rsd_radius_m() : config_.kappa_radius_m();
  const PointImage points = MakePointImage(tabletop, std::max(normal_radius_m, feature_radius_m),
                                           config_.component_reach_px());
  const NormalImage normals =
      EstimateNormals(points, {normal_radius_m, dense_px}, config_.min_normal_neighbors());
  std::vector<float> kappa(points.x.size(), 0.0F), r_min(points.x.size(), 0.0F);
  if (is_paper) {
    r_min = EstimateMinimumRadius(
        points, normals, {feature_radius_m, config_.rsd_num_bins(), config_.rsd_plane_radius_m()});
  } else {
    kappa = EstimateHorizontalCurvature(
        points, normals, tabletop.planes.front().plane.normal,
        {{feature_radius_m, dense_px}, config_.max_side_tilt_rad(), config_.max_kappa_residual()});
  }
  const Connection connection{config_.component_distance_m(), config_.component_distance_per_z2(),
                              config_.component_reach_px()};
  const ComponentImage components =
      LabelComponents(points, connection, config_.min_component_points());

  cloud.num_components = components.num_components;
  for (int j = 0; j < points.height; ++j) {
    for (int i = 0; i < points.width; ++i) {
      const size_t p = points.Index(i, j);
      if (components.label[p] < 0) continue;
      const int u = points.first_u + i * points.thinning;
      const int v = points.first_v + j * points.thinning;
      cloud.points.push_back({v * cloud.width + u,
                              {normals.x[p], normals.y[p], normals.z[p]},
                              kappa[p],
                              normals.curvature[p],
                              r_min[p],
                              components.label[p]});
    }
  }
  return cloud;
}

}  // namespace declutter
