#include "modules/feature_estimator/feature_estimator.h"

#include <algorithm>
#include <utility>

namespace declutter {

FeatureEstimator::FeatureEstimator(const FeatureEstimatorConfig& config) : config_(config) {}

const FeatureCloud& FeatureEstimator::Estimate(const Tabletop& tabletop) & {
  cloud_.header = tabletop.header;
  cloud_.mode = config_.mode() == "paper" ? FeatureMode::kPaper : FeatureMode::kDefault;
  cloud_.width = tabletop.objects.camera.width;
  cloud_.height = tabletop.objects.camera.height;
  cloud_.thinning = tabletop.thinning;
  cloud_.num_components = 0;
  if (tabletop.planes.empty()) {
    cloud_.points.clear();
    return cloud_;
  }
  EstimateFeatures(tabletop);
  const Connection connection{config_.component_distance_m(), config_.component_distance_per_z2(),
                              config_.component_reach_px()};
  components_ =
      FindComponents(points_, connection, config_.min_component_points(), std::move(components_));
  FillCloud();
  return cloud_;
}

void FeatureEstimator::EstimateFeatures(const Tabletop& tabletop) {
  const bool is_paper = cloud_.mode == FeatureMode::kPaper;
  const double normal_radius_m =
      is_paper ? config_.paper_normal_radius_m() : config_.normal_radius_m();
  const int dense_px = is_paper ? Neighborhood::kReadAll : config_.dense_window_px();
  const double feature_radius_m = is_paper ? config_.rsd_radius_m() : config_.kappa_radius_m();
  points_ = MakePointImage(tabletop, std::max(normal_radius_m, feature_radius_m),
                           config_.component_reach_px(), std::move(points_));
  normals_ = EstimateNormals(points_, {normal_radius_m, dense_px}, config_.min_normal_neighbors(),
                             std::move(normals_));
  if (is_paper) {
    radius_ = EstimateMinimumRadius(
        points_, normals_, {feature_radius_m, config_.rsd_num_bins(), config_.rsd_plane_radius_m()},
        std::move(radius_));
  } else {
    curvature_ = EstimateHorizontalCurvature(
        points_, normals_, tabletop.planes.front().plane.normal,
        {{feature_radius_m, dense_px}, config_.max_side_tilt_rad(), config_.max_kappa_residual()},
        std::move(curvature_));
  }
}

void FeatureEstimator::FillCloud() {
  const bool is_paper = cloud_.mode == FeatureMode::kPaper;
  size_t num_points = 0;
  for (const PointRun& run : components_.runs) {
    num_points += run.component >= 0 ? run.end - run.begin : 0;
  }
  cloud_.num_components = components_.num_components;
  cloud_.points.resize(num_points);
  FeaturePoint* point = cloud_.points.data();
  for (const PointRun& run : components_.runs) {
    if (run.component < 0) continue;
    const auto [column, row] = points_.PixelOf(run.begin);
    int32_t pixel = row * cloud_.width + column;
    for (size_t p = run.begin; p < run.end; ++p, pixel += points_.thinning) {
      *point++ = {pixel,
                  {normals_.x[p], normals_.y[p], normals_.z[p]},
                  is_paper ? 0.0F : curvature_.kappa[p],
                  normals_.curvature[p],
                  is_paper ? radius_.r_min[p] : 0.0F,
                  run.component};
    }
  }
}

}  // namespace declutter
