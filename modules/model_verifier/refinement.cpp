#include "modules/model_verifier/refinement.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "modules/model_verifier/ray_casting.h"
#include "modules/model_verifier/surface_points.h"

namespace declutter {
namespace {

constexpr double kMargin = 0.030;        // [m] around the solid where its points are looked for
constexpr double kEdgeMargin = 0.008;    // [m] along edges where surfaces are rounded or blurred
constexpr double kMinCos = 0.80;         // of a measured normal and the surface's
constexpr int kMinFacePoints = 60;       // [px] that move a face
constexpr double kMaxGrowth = 0.025;     // [m] that an edge moves outward at most
constexpr double kMaxShrinkage = 0.015;  // [m] that an edge moves inward at most
constexpr double kReference = 0.030;     // [m] of a face before its edge that give its full width

// A face of a box: the side `sign` of an axis of O.
struct BoxFace {
  int axis;
  int sign;
};

// All that can be seen: never the lower end.
constexpr BoxFace kFaces[] = {{0, 1}, {0, -1}, {1, 1}, {1, -1}, {2, 1}};

bool IsOn(const SurfacePoint& point, const BoxFace& face, const Eigen::Vector3d& half) {
  const double distance = face.sign * point.p_O[face.axis] - half[face.axis];
  if (std::abs(distance) > std::max(0.005, 3 * point.sigma)) return false;
  if (face.sign * point.ray_O[face.axis] > -0.05) return false;  // seen from behind or edge-on
  return point.n_O.isZero() || face.sign * point.n_O[face.axis] > kMinCos;
}

// Inside the face, `margin` away from its edges.
bool IsWithin(const SurfacePoint& point, int except_axis, const Eigen::Vector3d& half,
              double margin) {
  for (int axis = 0; axis < 3; ++axis) {
    if (axis != except_axis && std::abs(point.p_O[axis]) > half[axis] - margin) return false;
  }
  return true;
}

// 1 / variance of the distance to a surface with this normal. Half the sensor's noise does not
// average out at grazing rays, which bounds the weight.
double Weight(const SurfacePoint& point, double cosine) {
  const double sigma = point.sigma * std::max(std::abs(cosine), 0.5);
  return 1 / (sigma * sigma);
}

// Offsets of the faces that are seen, and the yaw about z of O, by linear least squares.
class BoxFit {
 public:
  BoxFit(const std::vector<SurfacePoint>& points, const Eigen::Vector3d& half) {
    for (const BoxFace& face : kFaces) {
      Accumulate(points, face, half);
    }
    Solve();
  }

  double yaw() const { return yaw_; }
  // [m] coordinate of the face along its axis; nothing when it was not seen.
  std::optional<double> Offset(const BoxFace& face) const { return offsets_[Index(face)]; }

 private:
  static size_t Index(const BoxFace& face) {
    return static_cast<size_t>(2 * face.axis + (face.sign > 0));
  }

  void Accumulate(const std::vector<SurfacePoint>& points, const BoxFace& face,
                  const Eigen::Vector3d& half) {
    Sums& sums = sums_[Index(face)];
    for (const SurfacePoint& point : points) {
      if (!IsOn(point, face, half) || !IsWithin(point, face.axis, half, kEdgeMargin)) continue;
      const double w = Weight(point, point.ray_O[face.axis]);
      // A yaw of the box by delta takes the plane x = o to x + delta * y = o.
      const double lever = face.axis == 0 ? point.p_O.y() : face.axis == 1 ? -point.p_O.x() : 0;
      const double x = point.p_O[face.axis];
      sums.num += point.num_px;
      sums.w += w;
      sums.x += w * x;
      sums.l += w * lever;
      sums.ll += w * lever * lever;
      sums.lx += w * lever * x;
    }
  }

  // Each offset minimises its own sum: o = mean(x) + yaw * mean(l), which leaves yaw alone.
  void Solve() {
    double numerator = 0;
    double denominator = 0;
    for (const Sums& s : sums_) {
      if (s.num < kMinFacePoints) continue;
      numerator -= s.lx - s.l * s.x / s.w;
      denominator += s.ll - s.l * s.l / s.w;
    }
    if (denominator > 0) yaw_ = std::clamp(numerator / denominator, -0.1, 0.1);
    for (size_t i = 0; i < 6; ++i) {
      const Sums& s = sums_[i];
      if (s.num >= kMinFacePoints) offsets_[i] = (s.x + yaw_ * s.l) / s.w;
    }
  }

  struct Sums {
    int num = 0;
    double w = 0, x = 0, l = 0, ll = 0, lx = 0;
  };
  Sums sums_[6];
  double yaw_ = 0;
  std::optional<double> offsets_[6];
};

// Where a surface ends along a coordinate: its area beyond a reference strip, divided by the width
// that the strip has. Samples are (outward coordinate, area).
std::optional<double> AreaEnd(const std::vector<std::pair<double, double>>& samples, int num_px,
                              double edge, double inner_limit) {
  const double begin = edge - kMaxShrinkage;
  const double reference = std::min(kReference, begin - inner_limit);
  if (reference < 0.008) return std::nullopt;
  double reference_area = 0;
  double beyond_area = 0;
  int num = 0;
  for (const auto& [x, area] : samples) {
    if (x > begin - reference && x <= begin) {
      reference_area += area;
      num += num_px;
    } else if (x > begin && x < edge + kMaxGrowth) {
      beyond_area += area;
    }
  }
  if (num < kMinFacePoints / 2) return std::nullopt;
  return std::min(begin + beyond_area / (reference_area / reference), edge + kMaxGrowth);
}

// The end of a box along one axis where its face is not seen: from the adjacent face with the most
// points near it.
std::optional<double> HiddenEnd(const std::vector<SurfacePoint>& points, const BoxFace& hidden,
                                const Eigen::Vector3d& half) {
  std::vector<std::pair<double, double>> best;
  for (const BoxFace& face : kFaces) {
    if (face.axis == hidden.axis) continue;
    const int across = 3 - face.axis - hidden.axis;
    std::vector<std::pair<double, double>> samples;
    for (const SurfacePoint& point : points) {
      if (!IsOn(point, face, half) || std::abs(point.p_O[across]) > half[across]) continue;
      samples.emplace_back(hidden.sign * point.p_O[hidden.axis],
                           point.pixel_area / std::abs(point.ray_O[face.axis]));
    }
    if (samples.size() > best.size()) best = std::move(samples);
  }
  return AreaEnd(best, points.empty() ? 1 : points[0].num_px, half[hidden.axis],
                 -half[hidden.axis]);
}

Solid RefineBox(Solid solid, const Observation& observation) {
  const std::vector<SurfacePoint> points = PointsNear(solid, kMargin, observation);
  const Eigen::Vector3d half = 0.5 * solid.size;
  const BoxFit fit(points, half);
  Eigen::Vector3d low = -half;
  Eigen::Vector3d high = half;
  for (const BoxFace& face : kFaces) {
    double& end = face.sign > 0 ? high[face.axis] : low[face.axis];
    if (const auto offset = fit.Offset(face)) {
      end = *offset;
    } else if (const auto hidden = HiddenEnd(points, face, half)) {
      end = face.sign * *hidden;
    }
  }
  if (((high - low).array() < 0.01).any()) return solid;
  const Eigen::AngleAxisd yaw(fit.yaw(), Eigen::Vector3d::UnitZ());
  solid.X_CO = solid.X_CO * yaw * Eigen::Translation3d(0.5 * (low + high));
  solid.size = high - low;
  return solid;
}

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
        std::abs(point.p_O.z()) > half_height - 0.5 * kEdgeMargin || distance < 1e-6) {
      continue;
    }
    const Eigen::Vector2d n = q / distance;
    const double cosine = n.dot(point.ray_O.head<2>());
    if (cosine > -0.4 || (!point.n_O.isZero() && n.dot(point.n_O.head<2>()) < kMinCos)) continue;
    const Eigen::Vector3d J(-n.x(), -n.y(), -1);
    const double w = Weight(point, cosine);
    H += w * J * J.transpose();
    g += w * J * residual;
    num += point.num_px;
  }
  if (num < kMinFacePoints) return false;
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
    if ((point.p_O.head<2>() - x.head<2>()).norm() > x.z() - kEdgeMargin) continue;
    const double w = Weight(point, point.ray_O.z());
    sum += w * point.p_O.z();
    weight += w;
    num += point.num_px;
  }
  if (num < kMinFacePoints) return std::nullopt;
  return sum / weight;
}

Solid RefineCylinder(Solid solid, const Observation& observation) {
  const std::vector<SurfacePoint> points = PointsNear(solid, kMargin, observation);
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

}  // namespace

Solid Refine(const Solid& solid, const Observation& observation) {
  return solid.shape == Shape::kBox ? RefineBox(solid, observation)
                                    : RefineCylinder(solid, observation);
}

namespace {

// Moves centre and radius of an upright cylinder in small steps as long as more speaks for it: the
// outline of its top and the space around it count where too little of its side is seen for a fit.
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

}  // namespace

void RefineIfNoWorse(const Observation& fitted, const Observation& judging, Solid* solid,
                     RayEvidence* evidence) {
  constexpr double kMaxLoss = 0.02;  // of the explained pixels: noise of the balance
  const Solid refined = Refine(*solid, fitted);
  RayEvidence refined_evidence = CastRays(refined, judging);
  if (refined_evidence.Balance() < evidence->Balance() - kMaxLoss * evidence->num_explained()) {
    if (solid->shape == Shape::kCylinder) ClimbCylinder(judging, solid, evidence);
    return;
  }
  const bool has_moved = refined.size != solid->size;
  *solid = refined;
  *evidence = std::move(refined_evidence);
  if (!has_moved && solid->shape == Shape::kCylinder) ClimbCylinder(judging, solid, evidence);
}

}  // namespace declutter
