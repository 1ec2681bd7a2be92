#include "modules/model_verifier/face_ends.h"

#include <algorithm>
#include <cmath>

#include "modules/geometry/sensor_noise.h"
#include "modules/model_verifier/face_end_kernels.h"
#include "modules/model_verifier/projection.h"
#include "modules/model_verifier/surface_fit.h"

namespace declutter {
namespace {

constexpr double kBin = 0.0005;          // [m]
constexpr double kMaxShrinkage = 0.015;  // [m] that an end moves inward at most
// [m] the same while solids still compete, seen by thinned pixels of which nobody knows whose they
// are: more would cut a box down to the part of something else that happens to be flat.
constexpr double kMaxEarlyShrinkage = 0.006;
constexpr double kMaxGrowth = kBin * EndProfile::kNumBins - kMaxShrinkage;  // [m] and outward
constexpr double kBlur = 0.002;  // [m] around an end where pixels of both sides mix
constexpr int kMinThere = 30;    // [px] of a face near its end
// What pixels count. Another object may continue a face, but nothing of a solid is where free space
// is.
constexpr int kThere = 1, kGone = 2;
// What a pixel without depth counts beside one that is gone, where both mix: mostly it is one of
// what is behind an edge, in the sensor's shadow.
constexpr double kUnknown = 0.25;

FaceLimits MakeLimits() {
  FaceLimits limits;
  limits.min_tolerance_m = 0.005f;
  limits.tolerance_per_square = static_cast<float>(3 * kSigmaPerSquaredDepth);
  limits.min_incidence_cos = 0.05f;
  limits.min_normal_cos = 0.7f;  // nearer to the face's than to that of one across it
  limits.edge_margin_m = static_cast<float>(0.5 * kFitEdgeMargin);
  limits.bin_m = static_cast<float>(kBin);
  limits.first_bin_m = static_cast<float>(-kMaxShrinkage);
  return limits;
}

// The part of a face that the profile of an end is about.
Solid RegionOf(const Solid& box, const FaceEnd& end) {
  Solid region = box;
  region.size[end.face_axis] = 0;
  region.size[end.end_axis] = kMaxShrinkage + kMaxGrowth;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  middle[end.face_axis] = 0.5 * end.face_sign * box.size[end.face_axis];
  middle[end.end_axis] = end.end_sign * 0.5 * (box.size[end.end_axis] + kMaxGrowth - kMaxShrinkage);
  region.X_CO = box.X_CO * Eigen::Translation3d(middle);
  return region;
}

// Bins from the beginning of a profile to the end.
std::optional<double> EndIn(const EndProfile& profile, int pixel_weight) {
  constexpr int kNumBins = EndProfile::kNumBins;
  constexpr int kNow = static_cast<int>(kMaxShrinkage / kBin + 0.5);
  constexpr int kReach = static_cast<int>(kBlur / kBin);
  int num_there = 0;
  for (const int32_t num : profile.there) num_there += num;
  if (num_there * pixel_weight < kMinThere) return std::nullopt;
  // Pixels that disagree with an end at the lower end of bin i; of equal ones the nearest.
  int cost = kThere * num_there;
  int least = cost;
  int best = 0;
  for (int i = 1; i <= kNumBins; ++i) {
    cost += kGone * profile.gone[i - 1] - kThere * profile.there[i - 1];
    if (cost < least || (cost == least && std::abs(i - kNow) < std::abs(best - kNow))) {
      least = cost;
      best = i;
    }
  }
  // To parts of a bin: a mixed one is filled by the share that is there.
  const int low = std::max(0, best - kReach);
  double end = low;
  for (int i = low; i < std::min(kNumBins, best + kReach); ++i) {
    const double there = profile.there[i];
    const double all = there + profile.gone[i] + kUnknown * profile.unknown[i];
    end += all > 0 ? there / all : static_cast<double>(i < best);
  }
  return end;
}

}  // namespace

std::optional<double> ShiftOfEnd(const Solid& box, int axis, int sign,
                                 const Observation& observation) {
  static const FaceLimits kLimits = MakeLimits();
  const RaySolid solid = AsRaySolid(box, observation.support);
  EndProfile profile;
  for (int face_axis = 0; face_axis < 3; ++face_axis) {
    if (face_axis == axis) continue;
    const float camera = solid.camera_O[face_axis];
    if (std::abs(camera) <= solid.half_size[face_axis]) continue;
    const int face_sign = camera > 0 ? 1 : -1;
    if (face_axis == 2 && face_sign < 0) continue;  // lower ends rest on something
    const FaceEnd end = {face_axis, face_sign, axis, sign};
    AddToProfile(solid, WindowOf(RegionOf(box, end), 0, observation), kLimits, end, &profile);
  }
  const auto end = EndIn(profile, observation.grid.pixel_weight());
  if (!end) return std::nullopt;
  const double max_shrinkage = observation.grid.step > 1 ? kMaxEarlyShrinkage : kMaxShrinkage;
  return std::max(kBin * *end - kMaxShrinkage, -max_shrinkage);
}

}  // namespace declutter
