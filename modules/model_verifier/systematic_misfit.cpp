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

// Distances of points from a side by their places along it. They are kept in bins as where the
// points begin and end, and so the strips between, is known last.
class SideProfile {
 public:
  // Places are within reach_m of 0.
  explicit SideProfile(double reach_m)
      : reach_m_(reach_m), bins_per_m_(kNumBins / std::max(1e-6, 2 * reach_m)) {}

  void Add(double place, double distance) {
    const auto bin = std::min(kNumBins - 1, static_cast<size_t>((place + reach_m_) * bins_per_m_));
    sums_[bin] += distance;
    ++nums_[bin];
    ++num_points_;
  }

  int num_points() const { return num_points_; }

  // [m] rms of the mean distances of strips; 0 where they are few.
  double Misfit() const {
    if (num_points_ == 0) return 0;
    size_t first = 0, end = kNumBins;
    while (nums_[first] == 0) ++first;
    while (nums_[end - 1] == 0) --end;
    double sum = 0;
    double square_sum = 0;
    int num = 0;
    for (size_t i = 0; i < kNumStrips; ++i) {
      const auto at = [&](size_t strip) { return first + strip * (end - first) / kNumStrips; };
      double strip_sum = 0;
      int strip_num = 0;
      for (size_t bin = at(i); bin < at(i + 1); ++bin) {
        strip_sum += sums_[bin];
        strip_num += nums_[bin];
      }
      if (strip_num < kMinPoints) continue;
      const double mean = strip_sum / strip_num;
      sum += mean;
      square_sum += mean * mean;
      ++num;
    }
    if (num < kMinStrips) return 0;
    return std::sqrt(std::max(0.0, square_sum / num - (sum / num) * (sum / num)));
  }

 private:
  static constexpr size_t kNumBins = 240;

  double reach_m_, bins_per_m_;
  std::array<double, kNumBins> sums_ = {};
  std::array<int, kNumBins> nums_ = {};
  int num_points_ = 0;
};

SideProfile OfCylinder(const Solid& solid, const std::vector<Eigen::Vector3d>& points_O,
                       const Eigen::Vector2d& sight_O) {
  SideProfile side(kOutline * solid.radius());
  for (const Eigen::Vector3d& p : points_O) {
    const Eigen::Vector2d q = p.head<2>();
    if (std::abs(p.z()) > 0.5 * solid.height() - kEdgeMargin) continue;
    const double angle = std::atan2(sight_O.x() * q.y() - sight_O.y() * q.x(), sight_O.dot(q));
    if (std::abs(angle) < kOutline) side.Add(angle * solid.radius(), q.norm() - solid.radius());
  }
  return side;
}

// Of the side of a box that is turned toward the camera across an axis.
SideProfile OfBox(const Solid& solid, const std::vector<Eigen::Vector3d>& points_O, int axis,
                  double sign) {
  const Eigen::Vector3d half = 0.5 * solid.size;
  SideProfile side(half[1 - axis]);
  for (const Eigen::Vector3d& p : points_O) {
    const double distance = sign * p[axis] - half[axis];
    if (std::abs(distance) < kEdgeMargin && std::abs(p.z()) < half.z() - kEdgeMargin &&
        std::abs(p[1 - axis]) < half[1 - axis] - kEdgeMargin) {
      side.Add(p[1 - axis], distance);
    }
  }
  return side;
}

}  // namespace

double SystematicMisfit(const Solid& solid, const std::vector<Eigen::Vector3d>& points_O) {
  const Eigen::Vector3d camera_O = solid.X_CO.inverse().translation();
  if (solid.shape == Shape::kCylinder) {
    return OfCylinder(solid, points_O, camera_O.head<2>()).Misfit();
  }
  const SideProfile side = OfBox(solid, points_O, 0, std::copysign(1.0, camera_O.x()));
  const SideProfile other = OfBox(solid, points_O, 1, std::copysign(1.0, camera_O.y()));
  return (side.num_points() > other.num_points() ? side : other).Misfit();
}

double LayerMisfit(const Solid& cylinder, const std::vector<Eigen::Vector3d>& points_O) {
  SideProfile side(0.5 * cylinder.height());
  for (const Eigen::Vector3d& p : points_O) {
    if (std::abs(p.z()) > 0.5 * cylinder.height() - kEdgeMargin) continue;
    side.Add(p.z(), p.head<2>().norm() - cylinder.radius());
  }
  return side.Misfit();
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
  constexpr double kMinNum = 30;
  constexpr double kPixelsPerSample = 36;  // over which the noise of a sensor is correlated
  // Of heights and distances from the side.
  double num = 0, sum_z = 0, sum_d = 0, sum_zz = 0, sum_zd = 0;
  double low = 1;
  double high = -1;
  for (const Eigen::Vector3d& p : points_O) {
    if (std::abs(p.z()) > 0.5 * cylinder.height() - kEdgeMargin) continue;
    const double d = p.head<2>().norm() - cylinder.radius();
    ++num;
    sum_z += p.z();
    sum_d += d;
    sum_zz += p.z() * p.z();
    sum_zd += p.z() * d;
    low = std::min(low, p.z());
    high = std::max(high, p.z());
  }
  if (num < kMinNum || high - low < kMinHeight) return {};
  const double zz = sum_zz - sum_z * sum_z / num;
  const double zd = sum_zd - sum_z * sum_d / num;
  return {zd / zz, sigma * std::sqrt(kPixelsPerSample / zz)};
}

}  // namespace declutter
