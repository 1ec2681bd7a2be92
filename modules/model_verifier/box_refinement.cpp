#include "modules/model_verifier/box_refinement.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "modules/model_verifier/surface_fit.h"

namespace declutter {
namespace {

constexpr double kMaxGrowth = 0.025;     // [m] that an edge moves outward at most
constexpr double kMaxShrinkage = 0.015;  // [m] that an edge moves inward at most
constexpr double kReference = 0.030;     // [m] of a face before its edge that give its full width
constexpr double kMinReference = 0.008;  // [m] of them at least

// A face of a box: the side `sign` of an axis of O.
struct BoxFace {
  int axis;
  int sign;
};

// All that can be seen: never the lower end.
constexpr BoxFace kFaces[] = {{0, 1}, {0, -1}, {1, 1}, {1, -1}, {2, 1}};

bool IsOn(const FitPoint& point, const BoxFace& face) {
  return (point.surfaces & SurfaceBit(face.axis, face.sign)) != 0;
}

// Inside a face across an axis, away from its edges.
bool IsWithin(const FitPoint& point, int axis, const Eigen::Vector3f& inner) {
  const int a = axis == 0 ? 1 : 0, b = axis == 2 ? 1 : 2;
  return std::abs(point.p_O[a]) <= inner[a] && std::abs(point.p_O[b]) <= inner[b];
}

// Offsets of the faces that are seen, and the yaw about z of O, by linear least squares.
class BoxFit {
 public:
  BoxFit(const FitPoints& points, const Eigen::Vector3d& half) {
    const Eigen::Vector3f inner = (half.array() - kFitEdgeMargin).cast<float>();
    for (const FitPoint& point : points) {
      for (uint32_t bits = point.surfaces; bits != 0; bits &= bits - 1) {
        const int index = __builtin_ctz(bits);
        if (IsWithin(point, index / 2, inner)) {
          Accumulate(point, index / 2, points.pixel_weight(), &sums_[index]);
        }
      }
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

  struct Sums {
    int num = 0;
    double w = 0, x = 0, l = 0, ll = 0, lx = 0;
  };

  // A point of a face across an axis.
  static void Accumulate(const FitPoint& point, int axis, int num_px, Sums* sums) {
    const double w = Weight(point, point.ray_O[axis]);
    // A yaw of the box by delta takes the plane x = o to x + delta * y = o.
    const double lever = axis == 0 ? point.p_O[1] : axis == 1 ? -point.p_O[0] : 0;
    const double x = point.p_O[axis];
    sums->num += num_px;
    sums->w += w;
    sums->x += w * x;
    sums->l += w * lever;
    sums->ll += w * lever * lever;
    sums->lx += w * lever * x;
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

  Sums sums_[6];  // of the face whose bit FitPoint::surfaces has there
  double yaw_ = 0;
  std::optional<double> offsets_[6];
};

// Where a face ends beyond a hidden end of a box: its area beyond a reference strip, divided by the
// width that the strip has. Coordinates are outward.
class AreaEnd {
 public:
  // edge: where the box ends now, inner_limit: where it begins.
  AreaEnd(double edge, double inner_limit)
      : edge_(edge),
        begin_(edge - kMaxShrinkage),
        reference_(std::min(kReference, begin_ - inner_limit)) {}

  void Add(double x, double area, int num_px) {
    ++num_points_;
    if (x > begin_ - reference_ && x <= begin_) {
      reference_area_ += area;
      num_reference_px_ += num_px;
    } else if (x > begin_ && x < edge_ + kMaxGrowth) {
      beyond_area_ += area;
    }
  }

  int num_points() const { return num_points_; }

  // Nothing when there is too little of the face.
  std::optional<double> End() const {
    if (reference_ < kMinReference || num_reference_px_ < kMinFitPoints / 2) return std::nullopt;
    return std::min(begin_ + beyond_area_ / (reference_area_ / reference_), edge_ + kMaxGrowth);
  }

 private:
  double edge_, begin_, reference_;
  double reference_area_ = 0, beyond_area_ = 0;
  int num_points_ = 0, num_reference_px_ = 0;
};

// The end of a box along one axis where its face is not seen: from the adjacent face with the most
// points.
std::optional<double> HiddenEnd(const FitPoints& points, const BoxFace& hidden,
                                const Eigen::Vector3d& half) {
  std::optional<AreaEnd> best;
  for (const BoxFace& face : kFaces) {
    if (face.axis == hidden.axis) continue;
    const int across = 3 - face.axis - hidden.axis;
    AreaEnd end(half[hidden.axis], -half[hidden.axis]);
    for (const FitPoint& point : points) {
      if (!IsOn(point, face) || std::abs(point.p_O[across]) > half[across]) continue;
      end.Add(static_cast<float>(hidden.sign) * point.p_O[hidden.axis],
              point.pixel_area / std::abs(point.ray_O[face.axis]), points.pixel_weight());
    }
    if (!best || end.num_points() > best->num_points()) best = end;
  }
  return best->End();
}

}  // namespace

Solid RefineBox(Solid solid, const Observation& observation, FitPoints* buffer) {
  buffer->Find(solid, observation);
  const FitPoints& points = *buffer;
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
