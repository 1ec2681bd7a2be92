#include "modules/model_verifier/cylinder_refinement.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "modules/model_verifier/surface_fit.h"

namespace declutter {
namespace {

// Gauss-Newton step for centre and radius on the points of the side; false when there are too few.
bool FitSide(const std::vector<SurfacePoint>& points, double half_height, Eigen::Vector3d* x) {
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
  int num = 0;
  for (const SurfacePoint& point : points) {
    const Eigen::Vector2d q = point.p_O.head<2>() - x->head<2>();
    const double distance = q.norm();
    const double residual = distance - x->z();
    if (std::abs(residual) > std::max(0.005, 3 * point.sigma) ||
        std::abs(point.p_O.z()) > half_height - 0.5 * kFitEdgeMargin || distance < 1e-6) {
      continue;
    }
    const Eigen::Vector2d n = q / distance;
    const double cosine = n.dot(point.ray_O.head<2>());
    if (cosine > -0.4 || (!point.n_O.isZero() && n.dot(point.n_O.head<2>()) < kMinFitCos)) continue;
    const Eigen::Vector3d J(-n.x(), -n.y(), -1);
    const double w = Weight(point, cosine);
    H += w * J * J.transpose();
    g += w * J * residual;
    num += point.num_px;
  }
  if (num < kMinFitPoints) return false;
  *x -= H.ldlt().solve(g);
  return x->allFinite() && x->z() > 0.005;
}

// Mean height of the disc inside the rim; nothing for an open cylinder.
std::optional<double> TopOfDisc(const std::vector<SurfacePoint>& points, const Eigen::Vector3d& x,
                                double half_height) {
  double sum = 0;
  double weight = 0;
  int num = 0;
  for (const SurfacePoint& point : points) {
    if (!IsOn(point, {2, 1}, Eigen::Vector3d::Constant(half_height))) continue;
    if ((point.p_O.head<2>() - x.head<2>()).norm() > x.z() - kFitEdgeMargin) continue;
    const double w = Weight(point, point.ray_O.z());
    sum += w * point.p_O.z();
    weight += w;
    num += point.num_px;
  }
  if (num < kMinFitPoints) return std::nullopt;
  return sum / weight;
}

}  // namespace

Solid RefineCylinder(Solid solid, const Observation& observation) {
  const std::vector<SurfacePoint> points = PointsNear(solid, kFitMargin, observation);
  const double half_height = 0.5 * solid.height();
  Eigen::Vector3d x(0, 0, solid.radius());  // centre, radius
  for (int iteration = 0; iteration < 4; ++iteration) {
    Eigen::Vector3d next = x;
    if (!FitSide(points, half_height, &next)) break;
    x = next;
  }
  if (x.head<2>().norm() > 0.02 || std::abs(x.z() - solid.radius()) > 0.02) return solid;
  double top = half_height;
  if (const auto disc = TopOfDisc(points, x, half_height)) top = *disc;
  solid.X_CO = solid.X_CO * Eigen::Translation3d(x.x(), x.y(), 0.5 * (top - half_height));
  solid.size = Eigen::Vector3d(2 * x.z(), 2 * x.z(), top + half_height);
  return solid;
}

void ClimbCylinder(const Observation& observation, Solid* solid, RayEvidence* evidence) {
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
  for (const double step : kSteps) {
    for (int round = 0; round < kMaxRounds; ++round) {
      bool has_climbed = false;
      for (const auto& [growth, shift_O] : directions) {
        for (const double sign : {-step, step}) {
          Solid moved = *solid;
          moved.X_CO.translation() += sign * (moved.X_CO.linear() * shift_O);
          moved.size.head<2>().array() += 2 * sign * growth;
          if (moved.radius() < 0.01) continue;
          RayEvidence moved_evidence = CastRays(moved, observation);
          if (moved_evidence.Balance() <= evidence->Balance()) continue;
          *solid = moved;
          *evidence = std::move(moved_evidence);
          has_climbed = true;
        }
      }
      if (!has_climbed) break;
    }
  }
}

}  // namespace declutter
