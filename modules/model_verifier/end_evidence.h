#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "modules/geometry/depth_image.h"
#include "modules/geometry/solid.h"
#include "modules/model_verifier/ray_casting.h"

namespace declutter {

// What tells where a solid ends, best first.
enum class EndEvidence : int8_t {
  kFace,       // points on the face there
  kEdge,       // free space behind the edge of another face
  kSupport,    // it stands on the support plane
  kFreeSpace,  // hidden, but it cannot reach much farther: free space would be inside
  kAssumed,    // hidden
};

// The two ends along each axis of O, the lower coordinate first.
using SolidEnds = std::array<std::array<EndEvidence, 2>, 3>;

// [m^2] of the two ends along each axis.
using EndVariances = std::array<std::array<double, 2>, 3>;

inline constexpr int kMinViolating = 25;  // [px] of free space that a longer solid would take

// How far a hidden end may lie beyond its place when it is kFreeSpace [m].
inline constexpr double kFreeSpaceReach = 0.020;

// From what was explained of a solid (points_O, in its frame), from what is measured just beyond
// its ends, and from the free space that a longer one would take. `given` is what the extents of
// its hypothesis rest on: what nobody saw there is seen as an end only where there are points on
// its face.
SolidEnds EndsOf(const Solid& solid, const std::array<Evidence, 3>& given,
                 const RayEvidence& evidence, const std::vector<Eigen::Vector3d>& points_O,
                 const Observation& observation, RayEvidence* buffer);

// What an extent rests on: the weaker of its ends.
std::array<Evidence, 3> ExtentEvidence(const SolidEnds& ends);

}  // namespace declutter
