#include "modules/model_verifier/cylinder_refinement.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "modules/model_verifier/surface_fit.h"

namespace declutter {
namespace {

constexpr double kRest = 1e-6;  // [m] of a step that ends a fit

// Gauss-Newton step for centre and radius on the points of the side; false when there are too few.
bool FitSide(const FitPoints& points, Eigen::Vector3d* x) {
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
  int num = 0;
  for (const FitPoint& point : points) {
    if ((point.surfaces & kCylinderSideBit) == 0) continue;
    const Eigen::Vector2d q = Eigen::Vector2d(point.p_O[0], point.p_O[1]) - x->head<2>();
    const double distance = q.norm();
    const double residual = distance - x->z();
    if (std::abs(residual) > std::max(0.005, 3.0 * point.sigma) || distance < 1e-6) continue;
    const Eigen::Vector2d n = q / distance;
    const double cosine = n.x() * point.ray_O[0] + n.y() * point.ray_O[1];
    const bool has_normal = point.n_O[0] != 0 || point.n_O[1] != 0 || point.n_O[2] != 0;
    if (cosine > -0.4 || (has_normal && n.x() * point.n_O[0] + n.y() * point.n_O[1] < kMinFitCos)) {
      continue;
    }
    const Eigen::Vector3d J(-n.x(), -n.y(), -1);
    const double w = Weight(point, cosine);
    H += w * J * J.transpose();
    g += w * J * residual;
    num += points.pixel_weight();
  }
  if (num < kMinFitPoints) return false;
  *x -= H.ldlt().solve(g);
  return x->allFinite() && x->z() > 0.005;
}

// Mean height of the disc inside the rim; nothing for an open cylinder.
std::optional<double> TopOfDisc(const FitPoints& points, const Eigen::Vector3d& x) {
  double sum = 0;
  double weight = 0;
  int num = 0;
  for (const FitPoint& point : points) {
    if ((point.surfaces & SurfaceBit(2, 1)) == 0) continue;
    const Eigen::Vector2d p(point.p_O[0], point.p_O[1]);
    if ((p - x.head<2>()).norm() > x.z() - kFitEdgeMargin) continue;
    const double w = Weight(point, point.ray_O[2]);
    sum += w * point.p_O[2];
    weight += w;
    num += points.pixel_weight();
  }
  if (num < kMinFitPoints) return std::nullopt;
  return sum / weight;
}

}  // namespace

Solid RefineCylinder(Solid solid, const Observation& observation, FitPoints* buffer) {
  buffer->Find(solid, observation);
  const FitPoints& points = *buffer;
  const double half_height = 0.5 * solid.height();
  Eigen::Vector3d x(0, 0, solid.radius());  // centre, radius
  for (int iteration = 0; iteration < 4; ++iteration) {
    Eigen::Vector3d next = x;
    if (!FitSide(points, &next)) break;
    const bool is_at_rest = (next - x).cwiseAbs().maxCoeff() < kRest;
    x = next;
    if (is_at_rest) break;
  }
  if (x.head<2>().norm() > 0.02 || std::abs(x.z() - solid.radius()) > 0.02) return solid;
  double top = half_height;
  if (const auto disc = TopOfDisc(points, x)) top = *disc;
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
