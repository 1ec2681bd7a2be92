#pragma once

#include <optional>

#include "modules/geometry/solid.h"
#include "modules/model_verifier/observation.h"

namespace declutter {

// [m] outward from where a box ends on one side of an axis of O to where the faces beside that end
// do; nothing when too little is seen of them. Every pixel whose ray meets the plane of a face near
// the end says whether the face is still there or no longer; the end lies where the fewest pixels
// disagree. What hides a part of the edge, or continues the face beside it, does not move it, and
// an end that is hidden stays where it is unless something is seen of it.
std::optional<double> ShiftOfEnd(const Solid& box, int axis, int sign,
                                 const Observation& observation);

}  // namespace declutter
