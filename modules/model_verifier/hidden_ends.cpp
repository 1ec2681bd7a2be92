#include "modules/model_verifier/hidden_ends.h"

#include <algorithm>
#include <cmath>

#include "modules/model_verifier/extents.h"
#include "modules/model_verifier/shared_space.h"
#include "modules/model_verifier/support_settling.h"

namespace declutter {
namespace {

constexpr double kMeanHidden = 0.025;     // [m] of an object that others hide
constexpr double kMaxRoom = 0.12;         // [m] behind others, beyond which next to none reach
constexpr double kRoomStep = 0.005;       // [m] to which it is found
constexpr double kMaxSharedSpace = 0.02;  // of an added part, inside another solid
constexpr double kMaxBelow = 0.004;       // [m] under the support plane: noise
constexpr double kLayer = 0.002;          // [m] by which an end that overlaps others is cut
constexpr double kMaxCut = 0.4;           // of an extent
constexpr double kMaxSharedLayer = 0.1;   // of a layer, inside another solid: less is a corner
constexpr double kMinSd = 0.003;          // [m] of an end that cannot move

// What an end adds as it moves outward.
Solid AddedPart(Solid solid, int axis, int sign, double growth) {
  solid.X_CO.translation() +=
      0.5 * sign * (solid.size[axis] + growth) * solid.X_CO.linear().col(axis);
  solid.size[axis] = growth;
  return solid;
}

// [m] that an end can move outward.
double RoomBeyond(const Solid& box, int axis, int sign, const std::vector<Solid>& others,
                  const Observation& observation, RayEvidence* buffer) {
  const double lowest = std::min(0.0, BottomOf(box, observation.support)) - kMaxBelow;
  const auto is_possible = [&](double growth) {
    const Solid part = AddedPart(box, axis, sign, growth);
    if (BottomOf(part, observation.support) < lowest) return false;
    const auto is_in_part = [&](const Solid& other) {
      return ShareSpace(part, other, kMaxSharedSpace);
    };
    if (std::any_of(others.begin(), others.end(), is_in_part)) return false;
    CastRays(part, observation, buffer);
    return buffer->num_violating < kMinViolating;
  };
  double room = 0;
  double too_far = std::min(kMaxRoom, kMaxExtent - box.size[axis]);
  if (too_far <= 0) return 0;
  if (is_possible(too_far)) return too_far;
  while (too_far - room > kRoomStep) {
    const double middle = 0.5 * (room + too_far);
    (is_possible(middle) ? room : too_far) = middle;
  }
  return room;
}

// [m] to cut from an end that reaches into others; 0 where too little would be left.
double OverlapAt(const Solid& box, int axis, int sign, const std::vector<Solid>& others) {
  const double max_overlap = std::min(kMaxCut * box.size[axis], box.size[axis] - kMinExtent);
  for (double overlap = 0; overlap <= max_overlap; overlap += kLayer) {
    const Solid layer = AddedPart(Longer(box, axis, sign, -overlap - kLayer), axis, sign, kLayer);
    const auto is_in_layer = [&](const Solid& other) {
      return ShareSpace(layer, other, kMaxSharedLayer);
    };
    if (std::none_of(others.begin(), others.end(), is_in_layer)) return overlap;
  }
  return 0;
}

// [m] the median of an exponential distribution that ends at `room`.
double MedianUpTo(double room) {
  return -kMeanHidden * std::log(0.5 + 0.5 * std::exp(-room / kMeanHidden));
}

// [m^2] its variance.
double VarianceUpTo(double room) {
  const double ratio = room / kMeanHidden;
  const double beyond = std::exp(-ratio);
  const double share = ratio > 0 ? 1 - ratio * ratio * beyond / ((1 - beyond) * (1 - beyond)) : 0.0;
  return std::max(kMinSd * kMinSd, kMeanHidden * kMeanHidden * share);
}

}  // namespace

void CompleteHiddenEnds(const SolidEnds& ends, const std::vector<Solid>& others,
                        const Observation& observation, Solid* box, EndVariances* variances,
                        RayEvidence* buffer) {
  const Solid seen = *box;
  // The lower end of what stands is on its support.
  const int num_axes = IsUpright(seen, observation.support) ? 2 : 3;
  for (int axis = 0; axis < num_axes; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const EndEvidence end = ends[static_cast<size_t>(axis)][static_cast<size_t>(side)];
      if (end != EndEvidence::kAssumed && end != EndEvidence::kFreeSpace) continue;
      double& variance = (*variances)[static_cast<size_t>(axis)][static_cast<size_t>(side)];
      const int sign = side == 0 ? -1 : 1;
      const double overlap = OverlapAt(*box, axis, sign, others);
      if (overlap > 0) {
        *box = Longer(*box, axis, sign, -overlap);
        variance = VarianceUpTo(0);
      } else if (end == EndEvidence::kAssumed) {
        const double room = RoomBeyond(seen, axis, sign, others, observation, buffer);
        *box = Longer(*box, axis, sign, MedianUpTo(room));
        variance = VarianceUpTo(room);
      }
    }
  }
}

}  // namespace declutter
