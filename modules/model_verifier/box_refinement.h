#pragma once

#include "modules/geometry/solid.h"
#include "modules/model_verifier/fit_points.h"
#include "modules/model_verifier/observation.h"

namespace declutter {

// Moves the faces of a box that are seen onto their points, turns it about z of O with them, and
// moves edges behind which no face is seen to where the faces beside them end.
Solid RefineBox(Solid solid, const Observation& observation, FitPoints* points);

}  // namespace declutter
