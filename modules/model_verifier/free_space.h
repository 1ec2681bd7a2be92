#pragma once

#include "modules/geometry/solid.h"
#include "modules/model_verifier/ray_casting.h"

namespace declutter {

// [px]: fewer than this see through the edges of a solid in its right place.
inline constexpr int kMaxSeenThrough = 60;

// [px] that see deeper into a solid than a carton bulges or a sensor bends it: free space
// that is no part of it. The evidence is a buffer.
int NumSeenThrough(const Solid& solid, const Observation& observation, RayEvidence* buffer);

}  // namespace declutter
