#pragma once

#include "modules/geometry/solid.h"
#include "modules/model_verifier/ray_casting.h"
#include "modules/model_verifier/surface_points.h"

namespace declutter {

// Gauss-Newton on the points of the side for centre and radius; the top moves onto its disc.
Solid RefineCylinder(Solid solid, const Observation& observation, SurfacePoints* buffer);

// Moves centre and radius of an upright cylinder in small steps as long as more speaks for it: the
// outline of its top and the space around it count where too little of its side is seen for a fit.
// evidence is that of the solid, and is renewed with it.
void ClimbCylinder(const Observation& observation, Solid* solid, RayEvidence* evidence,
                   RayEvidence* buffer);

}  // namespace declutter
