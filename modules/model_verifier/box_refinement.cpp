#include "modules/model_verifier/box_refinement.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "modules/model_verifier/face_ends.h"
#include "modules/model_verifier/fit_sums.h"
#include "modules/model_verifier/support_settling.h"
#include "modules/model_verifier/surface_fit.h"

namespace declutter {
namespace {

constexpr double kMaxYaw = 0.1;  // [rad] that a box is turned at most

// A face of a box: the side `sign` of an axis of O.
struct BoxFace {
  int axis;
  int sign;
};

// The lower end last: of what stands it is never seen.
constexpr std::array<BoxFace, 6> kFaces = {{{0, 1}, {0, -1}, {1, 1}, {1, -1}, {2, 1}, {2, -1}}};

FaceSums SumsOf(const BoxFace& face, const FitPoints& points, const Eigen::Vector3d& half,
                double edge_margin) {
  FaceRegion region;
  region.axis = face.axis;
  region.sign = face.sign;
  for (int i = 0; i < 3; ++i) region.half_size[i] = static_cast<float>(half[i]);
  region.edge_margin = static_cast<float>(edge_margin);
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

// The box between these ends, and turned about z of O.
Solid Between(const Eigen::Vector3d& low, const Eigen::Vector3d& high, double yaw, Solid solid) {
  solid.X_CO = solid.X_CO * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
               Eigen::Translation3d(0.5 * (low + high));
  solid.size = high - low;
  return solid;
}

bool IsTooSmall(const Eigen::Vector3d& size) { return (size.array() < 0.01).any(); }

}  // namespace

Solid RefineBox(Solid solid, const Observation& observation, FitPoints* points) {
  points->Find(solid, observation);
  Eigen::Vector3d high = 0.5 * solid.size;
  Eigen::Vector3d low = -high;
  std::array<FaceSums, kFaces.size()> sums;
  const size_t num_faces =
      IsUpright(solid, observation.support) ? kFaces.size() - 1 : kFaces.size();
  for (size_t i = 0; i < num_faces; ++i) {
    sums[i] = SumsOf(kFaces[i], *points, 0.5 * solid.size, kFitEdgeMargin);
  }
  const double yaw = YawOf(sums);
  for (size_t i = 0; i < num_faces; ++i) {
    const BoxFace& face = kFaces[i];
    // What is blurred tells where a small face is, but not how it is turned.
    if (!IsSeen(sums[i])) sums[i] = SumsOf(face, *points, 0.5 * solid.size, -kFitEdgeMargin);
    if (!IsSeen(sums[i])) continue;
    (face.sign > 0 ? high : low)[face.axis] += (sums[i].wx + yaw * sums[i].wl) / sums[i].w;
  }
  if (IsTooSmall(high - low)) return solid;
  solid = Between(low, high, yaw, solid);

  high = 0.5 * solid.size;
  low = -high;
  for (size_t i = 0; i < num_faces; ++i) {
    if (IsSeen(sums[i])) continue;
    const BoxFace& face = kFaces[i];
    if (const auto shift = ShiftOfEnd(solid, face.axis, face.sign, observation)) {
      (face.sign > 0 ? high : low)[face.axis] += face.sign * *shift;
    }
  }
  return IsTooSmall(high - low) ? solid : Between(low, high, 0, solid);
}

}  // namespace declutter
