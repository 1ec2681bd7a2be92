#pragma once

#include <Eigen/Core>
#include <vector>

#include "modules/model_verifier/fit_points.h"
#include "modules/model_verifier/ray_casting.h"

namespace declutter {

// What fits of boxes and of cylinders to surface points have in common.
inline constexpr double kFitEdgeMargin =
    0.008;                                  // [m] along edges where surfaces are rounded or blurred
inline constexpr double kMinFitCos = 0.80;  // of a measured normal and the surface's
inline constexpr int kMinFitPoints = 60;    // [px] that move a face

// Room for fits, used again by the next one.
struct FitBuffers {
  FitPoints points;
  RayEvidence evidence;
  std::vector<Eigen::Vector3d> explained_O;
};

}  // namespace declutter
