#pragma once

#include <vector>

#include "modules/geometry/solid.h"
#include "modules/model_verifier/end_evidence.h"
#include "modules/model_verifier/observation.h"
#include "modules/model_verifier/ray_casting.h"

namespace declutter {

// Moves the ends of a box of which nothing is seen to where they most likely are, and sets their
// variances; those of all others are left. An end that reaches into another solid ends before it.
// One that may lie anywhere behind what hides it (kAssumed) reaches on from where the seen part
// ends, at most to where free space or another solid would be inside; the longer a part that
// others hide, the rarer it is. The evidence is a buffer.
void CompleteHiddenEnds(const SolidEnds& ends, const std::vector<Solid>& others,
                        const Observation& observation, Solid* box, EndVariances* variances,
                        RayEvidence* buffer);

}  // namespace declutter
