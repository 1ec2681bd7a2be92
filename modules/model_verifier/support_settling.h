#pragma once

#include <vector>

#include "modules/geometry/solid.h"
#include "modules/model_verifier/ray_casting.h"

namespace declutter {

// Extends solids whose lower end nobody saw (evidence[2] is kAssumed) down to what they stand on,
// and sets what each stands on: the object below, or the support plane. Sorts the objects by the
// height of their tops; supported_by counts from 1 in that order.
void SettleOnSupports(const Observation& observation, std::vector<ObjectModel>* objects,
                      RayEvidence* buffer);

// True for a solid whose z axis is the support normal.
bool IsUpright(const Solid& solid, const Plane& support);

// [m] of the highest point of a solid above the support plane.
double TopOf(const Solid& solid, const Plane& support);

// A solid lengthened along its z axis down to the support plane.
Solid ExtendedToSupport(const Solid& solid, const Plane& support);

}  // namespace declutter
