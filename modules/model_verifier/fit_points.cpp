#include "modules/model_verifier/fit_points.h"

#include <iterator>

#include "modules/geometry/sensor_noise.h"
#include "modules/model_verifier/projection.h"
#include "modules/model_verifier/surface_fit.h"

namespace declutter {
namespace {

constexpr float kMarginOfBox = 0.012f;       // [m] what surfaces are blurred by, and a tolerance
constexpr float kMarginOfCylinder = 0.030f;  // [m] and how far a fit may move it

FitLimits LimitsWith(float margin_m) {
  FitLimits limits;
  limits.margin_m = margin_m;
  limits.sigma_per_square = static_cast<float>(kSigmaPerSquaredDepth);
  limits.min_tolerance_m = 0.005f;
  limits.tolerance_in_sigmas = 3;
  limits.min_incidence_cos = 0.05f;
  limits.min_normal_cos = static_cast<float>(kMinFitCos);
  limits.end_margin_m = static_cast<float>(0.5 * kFitEdgeMargin);
  return limits;
}

}  // namespace

void FitPoints::Find(const Solid& solid, const Observation& observation) {
  static const FitLimits kOfBox = LimitsWith(kMarginOfBox);
  static const FitLimits kOfCylinder = LimitsWith(kMarginOfCylinder);
  const FitLimits& limits = solid.shape == Shape::kBox ? kOfBox : kOfCylinder;
  const RayWindow window = WindowOf(solid, limits.margin_m, observation);
  const auto room = static_cast<size_t>(window.u_end - window.u_begin) *
                        static_cast<size_t>(window.v_end - window.v_begin) +
                    kRayPadding;
  float** const arrays[] = {&arrays_.p[0],   &arrays_.p[1], &arrays_.p[2],   &arrays_.n[0],
                            &arrays_.n[1],   &arrays_.n[2], &arrays_.ray[0], &arrays_.ray[1],
                            &arrays_.ray[2], &arrays_.sigma};
  buffer_.resize(room * std::size(arrays));
  for (size_t i = 0; i < std::size(arrays); ++i) *arrays[i] = &buffer_[i * room];
  surfaces_.resize(room);
  arrays_.surfaces = surfaces_.data();
  FindFitPoints(AsRaySolid(solid, observation.support), window, limits, &arrays_);
  pixel_weight_ = observation.grid.pixel_weight();
}

}  // namespace declutter
