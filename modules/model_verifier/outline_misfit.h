#pragma once

#include <optional>

#include "modules/geometry/solid.h"
#include "modules/model_verifier/ray_casting.h"

namespace declutter {

// [px] rms by which the free edge of the top of an upright solid, beside which the camera sees
// something lower, departs from the outline of its shape: from straight lines, each where its side
// of a box is, or from a circle. How large the solid is and where makes no difference. Nothing
// where too little of the edge is seen. evidence is what is observed of the solid.
std::optional<double> OutlineMisfit(const Solid& solid, const RayEvidence& evidence,
                                    const Observation& observation);

}  // namespace declutter
