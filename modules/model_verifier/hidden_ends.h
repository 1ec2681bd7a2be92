#pragma once

#include <vector>

#include "modules/geometry/solid.h"
#include "modules/model_verifier/end_evidence.h"
#include "modules/model_verifier/observation.h"
#include "modules/model_verifier/ray_casting.h"

namespace declutter {

// Moves those ends of a box that are not seen to the median of where they may be, and sets their
// variances; those of all others are left. An end that reaches into another solid ends before it.
// One behind which nothing tells how far it goes on (kAssumed) reaches on from where it was taken
// to be, at most to where free space, another solid or the support plane would be inside; the
// longer a part that others hide, the rarer it is. The evidence is a buffer.
void CompleteHiddenEnds(const SolidEnds& ends, const std::vector<Solid>& others,
                        const Observation& observation, Solid* box, EndVariances* variances,
                        RayEvidence* buffer);

}  // namespace declutter
