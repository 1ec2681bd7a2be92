#include "modules/model_verifier/systematic_misfit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "modules/geometry/sensor_noise.h"
#include "modules/model_verifier/outline_misfit.h"

namespace declutter {
namespace {

constexpr double kEdgeMargin = 0.006;  // [m] around edges, where surfaces are blurred
constexpr double kOutline = 1.0;       // [rad] from the line of sight: the outline of a cylinder
constexpr size_t kNumStrips = 6;
constexpr int kMinPoints = 3;  // of a strip that counts
constexpr int kMinStrips = 4;
constexpr double kMaxShare = 0.3;  // of what speaks for a solid that a misfit takes

// [m] of a point from the side of a cylinder; nothing for one around its ends or nearer to them.
std::optional<double> DistanceFromSide(const Solid& cylinder, const Eigen::Vector3d& p_O) {
  const double from_end = 0.5 * cylinder.height() - std::abs(p_O.z());
  if (from_end < kEdgeMargin) return std::nullopt;
  const double distance = p_O.head<2>().norm() - cylinder.radius();
  if (from_end < std::abs(distance)) return std::nullopt;
  return distance;
}

struct SidePoint {
  double along;     // [m]
  double distance;  // [m] from the side
};

struct Misfit {
  double rms = 0;  // [m] of the mean distances of strips; 0 where they are few
  int num_points = 0;
};

// Of those points of which `side_point` makes a SidePoint. It is asked twice: where they begin and
// end, and so the strips between, has to be known first.
template <class F>
Misfit MisfitOf(const std::vector<Eigen::Vector3d>& points_O, const F& side_point) {
  double low = std::numeric_limits<double>::max();
  double high = -low;
  Misfit misfit;
  for (const Eigen::Vector3d& p : points_O) {
    const std::optional<SidePoint> point = side_point(p);
    if (!point) continue;
    low = std::min(low, point->along);
    high = std::max(high, point->along);
    ++misfit.num_points;
  }
  const double strips_per_m = kNumStrips / std::max(1e-6, high - low);
  std::array<double, kNumStrips> sums = {};
  std::array<int, kNumStrips> nums = {};
  for (const Eigen::Vector3d& p : points_O) {
    const std::optional<SidePoint> point = side_point(p);
    if (!point) continue;
    const auto strip =
        std::min(kNumStrips - 1, static_cast<size_t>((point->along - low) * strips_per_m));
    sums[strip] += point->distance;
    ++nums[strip];
  }
  double sum = 0;
  double square_sum = 0;
  int num = 0;
  for (size_t i = 0; i < kNumStrips; ++i) {
    if (nums[i] < kMinPoints) continue;
    const double mean = sums[i] / nums[i];
    sum += mean;
    square_sum += mean * mean;
    ++num;
  }
  if (num < kMinStrips) return misfit;
  misfit.rms = std::sqrt(std::max(0.0, square_sum / num - (sum / num) * (sum / num)));
  return misfit;
}

Misfit OfCylinder(const Solid& solid, const std::vector<Eigen::Vector3d>& points_O,
                  const Eigen::Vector2d& sight_O) {
  return MisfitOf(points_O, [&](const Eigen::Vector3d& p) -> std::optional<SidePoint> {
    const auto distance = DistanceFromSide(solid, p);
    if (!distance) return std::nullopt;
    const Eigen::Vector2d q = p.head<2>();
    const double angle = std::atan2(sight_O.x() * q.y() - sight_O.y() * q.x(), sight_O.dot(q));
    if (std::abs(angle) >= kOutline) return std::nullopt;
    return SidePoint{angle * solid.radius(), *distance};
  });
}

// Of the side of a box that is turned toward the camera across an axis.
Misfit OfBox(const Solid& solid, const std::vector<Eigen::Vector3d>& points_O, int axis,
             double sign) {
  const Eigen::Vector3d half = 0.5 * solid.size;
  return MisfitOf(points_O, [&](const Eigen::Vector3d& p) -> std::optional<SidePoint> {
    const double distance = sign * p[axis] - half[axis];
    if (std::abs(distance) >= kEdgeMargin || std::abs(p.z()) >= half.z() - kEdgeMargin ||
        std::abs(p[1 - axis]) >= half[1 - axis] - kEdgeMargin) {
      return std::nullopt;
    }
    return SidePoint{p[1 - axis], distance};
  });
}

// As MisfitShare, of so many pixels between the free edge of a top and its outline.
double OutlineMisfitShare(double misfit_px) {
  constexpr double kNoise = 0.5;  // [px^2] that noise leaves of a part of an edge
  constexpr double kWeight = 0.1;
  return std::clamp(kWeight * (misfit_px * misfit_px - kNoise), 0.0, kMaxShare);
}

}  // namespace

double SystematicMisfit(const Solid& solid, const std::vector<Eigen::Vector3d>& points_O) {
  const Eigen::Vector3d camera_O = solid.X_CO.inverse().translation();
  if (solid.shape == Shape::kCylinder) {
    return OfCylinder(solid, points_O, camera_O.head<2>()).rms;
  }
  const Misfit side = OfBox(solid, points_O, 0, std::copysign(1.0, camera_O.x()));
  const Misfit other = OfBox(solid, points_O, 1, std::copysign(1.0, camera_O.y()));
  return (side.num_points > other.num_points ? side : other).rms;
}

double LayerMisfit(const Solid& cylinder, const std::vector<Eigen::Vector3d>& points_O) {
  return MisfitOf(points_O,
                  [&](const Eigen::Vector3d& p) -> std::optional<SidePoint> {
                    const auto distance = DistanceFromSide(cylinder, p);
                    if (!distance) return std::nullopt;
                    return SidePoint{p.z(), *distance};
                  })
      .rms;
}

std::optional<double> StepOf(const Solid& cylinder, const std::vector<Eigen::Vector3d>& points_O) {
  constexpr int kMinPart = 20;  // points
  constexpr int kNumLayers = 24;
  const double low = -0.5 * cylinder.height() + kEdgeMargin;
  const double layer = (cylinder.height() - 2 * kEdgeMargin) / kNumLayers;
  if (layer <= 0) return std::nullopt;
  std::array<double, kNumLayers> sums = {};
  std::array<int, kNumLayers> nums = {};
  double total = 0;
  int num_total = 0;
  for (const Eigen::Vector3d& p : points_O) {
    const auto distance = DistanceFromSide(cylinder, p);
    if (!distance) continue;
    const auto i = std::min<size_t>(kNumLayers - 1, static_cast<size_t>((p.z() - low) / layer));
    sums[i] += *distance;
    ++nums[i];
    total += *distance;
    ++num_total;
  }
  std::optional<double> step;
  double best = 0;
  double sum = 0;
  int num = 0;
  for (int i = 0; i + 1 < kNumLayers; ++i) {
    sum += sums[static_cast<size_t>(i)];
    num += nums[static_cast<size_t>(i)];
    if (num < kMinPart || num_total - num < kMinPart) continue;
    // What two means explain of the squares more than one.
    const double gain = sum * sum / num + (total - sum) * (total - sum) / (num_total - num);
    if (gain <= best) continue;
    best = gain;
    step = low + (i + 1) * layer;
  }
  return step;
}

double MisfitShare(double misfit_sigmas) {
  constexpr double kNoise = 0.1;  // [sigma^2] that noise, which neighbours share, leaves of a strip
  constexpr double kWeight = 0.4;
  return std::clamp(kWeight * (misfit_sigmas * misfit_sigmas - kNoise), 0.0, kMaxShare);
}

double MisfitShareOf(const Solid& solid, const RayEvidence& evidence,
                     const Observation& observation, std::vector<Eigen::Vector3d>* points_O) {
  FindExplainedPoints(solid, evidence, observation, points_O);
  const double of_side = SystematicMisfit(solid, *points_O);
  if (of_side > 0) return MisfitShare(of_side / MeasurementSigma(solid.X_CO.translation().z()));
  const auto of_outline = OutlineMisfit(solid, evidence, observation);
  return of_outline ? OutlineMisfitShare(*of_outline) : 0;
}

Taper TaperOf(const Solid& cylinder, const std::vector<Eigen::Vector3d>& points_O, double sigma) {
  constexpr double kMinHeight = 0.020;  // [m] between the points, to tell
  constexpr double kMinNum = 30;
  constexpr double kPixelsPerSample = 36;  // over which the noise of a sensor is correlated
  // Of heights and distances from the side.
  double num = 0, sum_z = 0, sum_d = 0, sum_zz = 0, sum_zd = 0;
  double low = 1;
  double high = -1;
  for (const Eigen::Vector3d& p : points_O) {
    const auto d = DistanceFromSide(cylinder, p);
    if (!d) continue;
    ++num;
    sum_z += p.z();
    sum_d += *d;
    sum_zz += p.z() * p.z();
    sum_zd += p.z() * *d;
    low = std::min(low, p.z());
    high = std::max(high, p.z());
  }
  if (num < kMinNum || high - low < kMinHeight) return {};
  const double zz = sum_zz - sum_z * sum_z / num;
  const double zd = sum_zd - sum_z * sum_d / num;
  return {zd / zz, sigma * std::sqrt(kPixelsPerSample / zz)};
}

}  // namespace declutter
