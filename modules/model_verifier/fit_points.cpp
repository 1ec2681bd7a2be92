#include "modules/model_verifier/fit_points.h"

#include <algorithm>

#include "modules/geometry/sensor_noise.h"
#include "modules/model_verifier/projection.h"
#include "modules/model_verifier/surface_fit.h"

namespace declutter {
namespace {

FitLimits LimitsFor(const PixelGrid& grid, const PinholeCamera& camera) {
  FitLimits limits;
  limits.margin_m = 0.030f;
  limits.sigma_per_square = static_cast<float>(kSigmaPerSquaredDepth);
  limits.min_tolerance_m = 0.005f;
  limits.tolerance_in_sigmas = 3;
  limits.min_incidence_cos = 0.05f;
  limits.min_normal_cos = static_cast<float>(kMinFitCos);
  limits.end_margin_m = static_cast<float>(0.5 * kFitEdgeMargin);
  limits.area_per_square = static_cast<float>(grid.pixel_weight() / (camera.fx * camera.fy));
  return limits;
}

}  // namespace

void FitPoints::Find(const Solid& solid, const Observation& observation) {
  const FitLimits limits = LimitsFor(observation.grid, observation.image.camera);
  const RayWindow window = WindowOf(solid, limits.margin_m, observation);
  const auto room = static_cast<size_t>(window.u_end - window.u_begin) *
                    static_cast<size_t>(window.v_end - window.v_begin);
  points_.resize(std::max(points_.size(), room));
  num_ = FindFitPoints(AsRaySolid(solid, observation.support), window, limits, points_.data());
  pixel_weight_ = observation.grid.pixel_weight();
}

}  // namespace declutter
