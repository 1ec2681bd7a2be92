#include "modules/model_verifier/cylinder_refinement.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "modules/model_verifier/fit_sums.h"
#include "modules/model_verifier/surface_fit.h"

namespace declutter {
namespace {

constexpr double kRest = 1e-6;  // [m] of a step that ends a fit

// The least cosine of incidence at which the side of a cylinder is fitted. The more oblique, the
// more does a point tell of the radius, unless its depth is that of a window of pixels, which at
// the outline reaches around the curve.
double MinIncidenceCos(const ImageNoise& noise) {
  constexpr double kOfWindows = 0.45, kOfPixels = 0.22;
  constexpr double kLow = 0.6, kHigh = 0.9;  // independence of windows, of pixels
  const double share = std::clamp((noise.independence - kLow) / (kHigh - kLow), 0.0, 1.0);
  return kOfWindows + share * (kOfPixels - kOfWindows);
}

// Gauss-Newton step for centre and radius on the points of the side; false when there are too few.
bool FitSide(const FitPoints& points, const ImageNoise& noise, Eigen::Vector3d* x) {
  SideRegion region;
  region.x = static_cast<float>(x->x());
  region.y = static_cast<float>(x->y());
  region.radius = static_cast<float>(x->z());
  region.min_tolerance_m = 0.005f;
  region.tolerance_in_sigmas = 3;
  region.min_incidence_cos = static_cast<float>(MinIncidenceCos(noise));
  region.min_normal_cos = static_cast<float>(kMinFitCos);
  const SideSums s = SumSide(points.arrays(), region);
  if (points.pixel_weight() * s.num < kMinFitPoints) return false;
  Eigen::Matrix3d H;
  H << s.nxnx, s.nxny, s.nx, s.nxny, s.nyny, s.ny, s.nx, s.ny, s.w;
  *x += H.ldlt().solve(Eigen::Vector3d(s.nxr, s.nyr, s.r));
  return x->allFinite() && x->z() > 0.005;
}

// Mean height [m] of the disc inside the rim, above the upper end at `height`; nothing for an open
// cylinder.
std::optional<double> HeightOfDisc(const FitPoints& points, const Eigen::Vector3d& x,
                                   double height) {
  const DiscRegion region{static_cast<float>(x.x()), static_cast<float>(x.y()),
                          static_cast<float>(x.z() - kFitEdgeMargin), static_cast<float>(height)};
  const DiscSums s = SumDisc(points.arrays(), region);
  if (points.pixel_weight() * s.num < kMinFitPoints) return std::nullopt;
  return s.wz / s.w;
}

}  // namespace

Solid RefineCylinder(Solid solid, const Observation& observation, FitPoints* points) {
  points->Find(solid, observation);
  const double half_height = 0.5 * solid.height();
  Eigen::Vector3d x(0, 0, solid.radius());  // centre, radius
  for (int iteration = 0; iteration < 4; ++iteration) {
    Eigen::Vector3d next = x;
    if (!FitSide(*points, observation.noise, &next)) break;
    const bool is_at_rest = (next - x).cwiseAbs().maxCoeff() < kRest;
    x = next;
    if (is_at_rest) break;
  }
  if (x.head<2>().norm() > 0.02 || std::abs(x.z() - solid.radius()) > 0.02) return solid;
  double top = half_height;
  if (const auto disc = HeightOfDisc(*points, x, half_height)) top += *disc;
  solid.X_CO = solid.X_CO * Eigen::Translation3d(x.x(), x.y(), 0.5 * (top - half_height));
  solid.size = Eigen::Vector3d(2 * x.z(), 2 * x.z(), top + half_height);
  return solid;
}

void ClimbCylinder(const Observation& observation, Solid* solid, RayEvidence* evidence,
                   RayEvidence* buffer) {
  constexpr double kSteps[] = {0.002, 0.001};  // [m]
  constexpr int kMaxRounds = 3;
  // Away from the camera, across the axis.
  Eigen::Vector3d back_O = -solid->X_CO.inverse().translation();
  back_O.z() = 0;
  back_O.normalize();
  const Eigen::Vector3d right_O(-back_O.y(), back_O.x(), 0);
  // (growth of the radius, shift of the centre): about the centre, and with the back, the front or
  // a side left where it is.
  const std::pair<double, Eigen::Vector3d> directions[] = {
      {1, Eigen::Vector3d::Zero()}, {1, -back_O}, {1, back_O}, {0, back_O}, {0, right_O}};
  const auto climb = [&](double step, const std::pair<double, Eigen::Vector3d>& direction) {
    for (const double sign : {-step, step}) {
      Solid moved = *solid;
      moved.X_CO.translation() += sign * (moved.X_CO.linear() * direction.second);
      moved.size.head<2>().array() += 2 * sign * direction.first;
      if (moved.radius() < 0.01) continue;
      CastRays(moved, observation, buffer);
      if (buffer->Balance() <= evidence->Balance()) continue;
      *solid = moved;
      std::swap(*evidence, *buffer);
      return true;  // the other way would lead back
    }
    return false;
  };
  constexpr int kNumDirections = std::size(directions);
  for (const double step : kSteps) {
    // Up to the top, from where every direction leads down.
    int num_down = 0;
    for (int i = 0; i < kMaxRounds * kNumDirections && num_down < kNumDirections; ++i) {
      num_down = climb(step, directions[i % kNumDirections]) ? 0 : num_down + 1;
    }
  }
}

}  // namespace declutter
