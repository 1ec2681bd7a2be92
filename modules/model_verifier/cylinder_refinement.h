#pragma once

#include "modules/geometry/solid.h"
#include "modules/model_verifier/fit_points.h"
#include "modules/model_verifier/ray_casting.h"

namespace declutter {

// Gauss-Newton on the points of the side for centre and radius; the top moves onto its disc.
Solid RefineCylinder(Solid solid, const Observation& observation, FitPoints* points);

// Moves centre and radius of an upright cylinder in small steps as long as more speaks for it: the
// outline of its top and the space around it count where too little of its side is seen for a fit.
// evidence is that of the solid, and is renewed with it.
void ClimbCylinder(const Observation& observation, Solid* solid, RayEvidence* evidence,
                   RayEvidence* buffer);

}  // namespace declutter
