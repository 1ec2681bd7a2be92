#include "modules/model_verifier/systematic_misfit.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace declutter {
namespace {

constexpr double kEdgeMargin = 0.006;  // [m] around edges, where surfaces are blurred
constexpr double kOutline = 1.0;       // [rad] from the line of sight: the outline of a cylinder
constexpr size_t kNumStrips = 6;
constexpr int kMinPoints = 3;  // of a strip that counts
constexpr int kMinStrips = 4;

struct SidePoint {
  double along;     // [m]
  double distance;  // [m] from the side
};

double MisfitOf(const std::vector<SidePoint>& points) {
  if (points.empty()) return 0;
  const auto [first, last] =
      std::minmax_element(points.begin(), points.end(),
                          [](const SidePoint& a, const SidePoint& b) { return a.along < b.along; });
  const double low = first->along;
  const double strips_per_m = kNumStrips / std::max(1e-6, last->along - low);
  std::array<double, kNumStrips> sums = {};
  std::array<int, kNumStrips> nums = {};
  for (const SidePoint& point : points) {
    const auto strip =
        std::min(kNumStrips - 1, static_cast<size_t>((point.along - low) * strips_per_m));
    sums[strip] += point.distance;
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
  if (num < kMinStrips) return 0;
  return std::sqrt(std::max(0.0, square_sum / num - (sum / num) * (sum / num)));
}

std::vector<SidePoint> OnCylinder(const Solid& solid, const std::vector<Eigen::Vector3d>& points_O,
                                  const Eigen::Vector2d& sight_O) {
  std::vector<SidePoint> side;
  for (const Eigen::Vector3d& p : points_O) {
    const Eigen::Vector2d q = p.head<2>();
    if (std::abs(p.z()) > 0.5 * solid.height() - kEdgeMargin) continue;
    const double angle = std::atan2(sight_O.x() * q.y() - sight_O.y() * q.x(), sight_O.dot(q));
    if (std::abs(angle) < kOutline) {
      side.push_back({angle * solid.radius(), q.norm() - solid.radius()});
    }
  }
  return side;
}

// Of the side of a box that is turned toward the camera across an axis.
std::vector<SidePoint> OnBox(const Solid& solid, const std::vector<Eigen::Vector3d>& points_O,
                             int axis, double sign) {
  const Eigen::Vector3d half = 0.5 * solid.size;
  std::vector<SidePoint> side;
  for (const Eigen::Vector3d& p : points_O) {
    const double distance = sign * p[axis] - half[axis];
    if (std::abs(distance) < kEdgeMargin && std::abs(p.z()) < half.z() - kEdgeMargin &&
        std::abs(p[1 - axis]) < half[1 - axis] - kEdgeMargin) {
      side.push_back({p[1 - axis], distance});
    }
  }
  return side;
}

}  // namespace

double SystematicMisfit(const Solid& solid, const std::vector<Eigen::Vector3d>& points_O) {
  const Eigen::Vector3d camera_O = solid.X_CO.inverse().translation();
  if (solid.shape == Shape::kCylinder) {
    return MisfitOf(OnCylinder(solid, points_O, camera_O.head<2>()));
  }
  std::vector<SidePoint> side = OnBox(solid, points_O, 0, std::copysign(1.0, camera_O.x()));
  std::vector<SidePoint> other = OnBox(solid, points_O, 1, std::copysign(1.0, camera_O.y()));
  return MisfitOf(side.size() > other.size() ? side : other);
}

double LayerMisfit(const Solid& cylinder, const std::vector<Eigen::Vector3d>& points_O) {
  std::vector<SidePoint> side;
  for (const Eigen::Vector3d& p : points_O) {
    if (std::abs(p.z()) > 0.5 * cylinder.height() - kEdgeMargin) continue;
    side.push_back({p.z(), p.head<2>().norm() - cylinder.radius()});
  }
  return MisfitOf(side);
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
    const double place = (p.z() - low) / layer;
    if (place < 0 || place >= kNumLayers) continue;
    const double distance = p.head<2>().norm() - cylinder.radius();
    sums[static_cast<size_t>(place)] += distance;
    ++nums[static_cast<size_t>(place)];
    total += distance;
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
  constexpr double kMaxShare = 0.3;
  return std::clamp(kWeight * (misfit_sigmas * misfit_sigmas - kNoise), 0.0, kMaxShare);
}

Taper TaperOf(const Solid& cylinder, const std::vector<Eigen::Vector3d>& points_O, double sigma) {
  constexpr double kMinHeight = 0.020;  // [m] between the points, to tell
  constexpr size_t kMinNum = 30;
  constexpr double kPixelsPerSample = 36;  // over which the noise of a sensor is correlated
  std::vector<Eigen::Vector2d> points;     // height, distance from the side
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double low = 1;
  double high = -1;
  for (const Eigen::Vector3d& p : points_O) {
    if (std::abs(p.z()) > 0.5 * cylinder.height() - kEdgeMargin) continue;
    points.emplace_back(p.z(), p.head<2>().norm() - cylinder.radius());
    mean += points.back();
    low = std::min(low, p.z());
    high = std::max(high, p.z());
  }
  if (points.size() < kMinNum || high - low < kMinHeight) return {};
  mean /= static_cast<double>(points.size());
  double zz = 0;
  double zd = 0;
  for (const Eigen::Vector2d& point : points) {
    zz += (point.x() - mean.x()) * (point.x() - mean.x());
    zd += (point.x() - mean.x()) * (point.y() - mean.y());
  }
  return {zd / zz, sigma * std::sqrt(kPixelsPerSample / zz)};
}

}  // namespace declutter
