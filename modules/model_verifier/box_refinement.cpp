#include "modules/model_verifier/box_refinement.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "modules/model_verifier/surface_fit.h"

namespace declutter {
namespace {

constexpr double kMaxGrowth = 0.025;     // [m] that an edge moves outward at most
constexpr double kMaxShrinkage = 0.015;  // [m] that an edge moves inward at most
constexpr double kReference = 0.030;     // [m] of a face before its edge that give its full width

// All that can be seen: never the lower end.
constexpr BoxFace kFaces[] = {{0, 1}, {0, -1}, {1, 1}, {1, -1}, {2, 1}};

// Inside the face, `margin` away from its edges.
bool IsWithin(const SurfacePoint& point, int except_axis, const Eigen::Vector3d& half,
              double margin) {
  for (int axis = 0; axis < 3; ++axis) {
    if (axis != except_axis && std::abs(point.p_O[axis]) > half[axis] - margin) return false;
  }
  return true;
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
      if (!IsOn(point, face, half) || !IsWithin(point, face.axis, half, kFitEdgeMargin)) continue;
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
      if (s.num < kMinFitPoints) continue;
      numerator -= s.lx - s.l * s.x / s.w;
      denominator += s.ll - s.l * s.l / s.w;
    }
    if (denominator > 0) yaw_ = std::clamp(numerator / denominator, -0.1, 0.1);
    for (size_t i = 0; i < 6; ++i) {
      const Sums& s = sums_[i];
      if (s.num >= kMinFitPoints) offsets_[i] = (s.x + yaw_ * s.l) / s.w;
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
  if (num < kMinFitPoints / 2) return std::nullopt;
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

}  // namespace

Solid RefineBox(Solid solid, const Observation& observation) {
  const std::vector<SurfacePoint> points = PointsNear(solid, kFitMargin, observation);
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

}  // namespace declutter
