#include "modules/model_verifier/box_refinement.h"

#include <algorithm>
#include <array>
#include <optional>

#include "modules/model_verifier/fit_sums.h"
#include "modules/model_verifier/surface_fit.h"

namespace declutter {
namespace {

constexpr double kMaxGrowth = 0.025;     // [m] that an edge moves outward at most
constexpr double kMaxShrinkage = 0.015;  // [m] that an edge moves inward at most
constexpr double kReference = 0.030;     // [m] of a face before its edge that give its full width
constexpr double kMinReference = 0.008;  // [m] of them at least
constexpr double kMaxYaw = 0.1;          // [rad] that a box is turned at most

// A face of a box: the side `sign` of an axis of O.
struct BoxFace {
  int axis;
  int sign;
};

// All that can be seen: never the lower end.
constexpr std::array<BoxFace, 5> kFaces = {{{0, 1}, {0, -1}, {1, 1}, {1, -1}, {2, 1}}};

// Of the points of a face, away from its edges.
FaceSums SumsOf(const BoxFace& face, const FitPoints& points, const Eigen::Vector3d& half) {
  FaceRegion region{face.axis, face.sign, static_cast<float>(face.sign * half[face.axis]), {}};
  for (int i = 0; i < 3; ++i) region.inner[i] = static_cast<float>(half[i] - kFitEdgeMargin);
  FaceSums sums = SumFace(points.arrays(), region);
  sums.num *= points.pixel_weight();
  return sums;
}

bool IsSeen(const FaceSums& sums) { return sums.num >= kMinFitPoints; }

// Yaw [rad] about z of O by linear least squares. The offset of each face minimises its own sum: it
// is mean(x) + yaw * mean(lever), which leaves yaw alone.
double YawOf(const std::array<FaceSums, kFaces.size()>& faces) {
  double numerator = 0;
  double denominator = 0;
  for (const FaceSums& s : faces) {
    if (!IsSeen(s)) continue;
    numerator -= s.wlx - s.wl * s.wx / s.w;
    denominator += s.wll - s.wl * s.wl / s.w;
  }
  return denominator > 0 ? std::clamp(numerator / denominator, -kMaxYaw, kMaxYaw) : 0;
}

// Where a face ends beyond a hidden end of a box: its area beyond a reference strip, divided by the
// width that the strip has. The end of a box along one axis where its face is not seen, outward:
// from the adjacent face with the most points. Nothing when there is too little of that.
std::optional<double> HiddenEnd(const FitPoints& points, const BoxFace& hidden,
                                const Eigen::Vector3d& half) {
  const double edge = half[hidden.axis];
  const double begin = edge - kMaxShrinkage;
  const double reference = std::min(kReference, begin + edge);
  if (reference < kMinReference) return std::nullopt;
  FaceStrips strips;
  strips.axis = hidden.axis;
  strips.sign = hidden.sign;
  strips.reference_begin = static_cast<float>(begin - reference);
  strips.begin = static_cast<float>(begin);
  strips.end = static_cast<float>(edge + kMaxGrowth);
  StripAreas most;
  for (const BoxFace& face : kFaces) {
    if (face.axis == hidden.axis) continue;
    strips.face_axis = face.axis;
    strips.face_sign = face.sign;
    strips.half_across = static_cast<float>(half[3 - face.axis - hidden.axis]);
    const StripAreas areas = SumStrips(points.arrays(), strips);
    if (areas.num > most.num) most = areas;
  }
  if (points.pixel_weight() * most.num_reference < kMinFitPoints / 2) return std::nullopt;
  return std::min(begin + most.beyond * reference / most.reference, edge + kMaxGrowth);
}

}  // namespace

Solid RefineBox(Solid solid, const Observation& observation, FitPoints* points) {
  points->Find(solid, observation);
  const Eigen::Vector3d half = 0.5 * solid.size;
  std::array<FaceSums, kFaces.size()> sums;
  for (size_t i = 0; i < kFaces.size(); ++i) sums[i] = SumsOf(kFaces[i], *points, half);
  const double yaw = YawOf(sums);
  Eigen::Vector3d low = -half;
  Eigen::Vector3d high = half;
  for (size_t i = 0; i < kFaces.size(); ++i) {
    const BoxFace& face = kFaces[i];
    double& end = face.sign > 0 ? high[face.axis] : low[face.axis];
    if (IsSeen(sums[i])) {
      end += (sums[i].wx + yaw * sums[i].wl) / sums[i].w;
    } else if (const auto hidden = HiddenEnd(*points, face, half)) {
      end = face.sign * *hidden;
    }
  }
  if (((high - low).array() < 0.01).any()) return solid;
  solid.X_CO = solid.X_CO * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
               Eigen::Translation3d(0.5 * (low + high));
  solid.size = high - low;
  return solid;
}

}  // namespace declutter
