#pragma once

#include "modules/geometry/plane.h"
#include "modules/geometry/solid.h"
#include "modules/model_verifier/ray_casting.h"

namespace declutter {

// Points above the support within reach of a solid, of an observation without the pixels that
// objects explain: where there are many, something else stands there than a box or an upright
// cylinder. Of a solid whose top is not seen, what goes on above it counts too: a bowl is a
// cylinder only near its rim.
int NumUnexplained(const Solid& solid, bool is_top_seen, const Observation& unexplained);

// In [0, 1]: mean fit of the explained pixels, times their share of all pixels that speak for or
// against the solid, unmeasured ones a little; less where its depth is a guess, 0 where it is too
// thin to be a solid, or lower than the waves of the sensor.
double Confidence(const ObjectModel& object, const RayEvidence& evidence, int num_unexplained,
                  const Plane& support);

}  // namespace declutter
