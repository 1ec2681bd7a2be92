#pragma once

#include <optional>

#include "modules/geometry/solid.h"
#include "modules/model_verifier/ray_casting.h"
#include "modules/model_verifier/surface_fit.h"

namespace declutter {

// Fits a solid to all points on its surface by weighted least squares (weight: inverse variance
// along the surface normal). Faces that are seen move onto their points; an end behind which no
// face is seen moves to where the faces beside it end, so that it is not biased by the pixels a
// percentile would cut off. Parameters without enough points keep their value.
Solid Refine(const Solid& solid, const Observation& observation, FitPoints* buffer);

// What a fit made of a solid.
struct FitResult {
  bool is_fitted = false;  // whether a fit has moved it; a climb is none
  // Of what speaks for the solid in its place, see MisfitShareOf; where it had to be known.
  std::optional<double> misfit_share;
};

// Refines a solid on one observation where that does not lose what speaks for it on another: with
// few points, or little of a cylinder's arc, a fit can go astray. evidence is what was observed of
// the solid on the second, and is renewed with it.
FitResult RefineIfNoWorse(const Observation& fitted, const Observation& judging, Solid* solid,
                          RayEvidence* evidence, FitBuffers* buffers);

// The same; a cylinder that the fit could not move, or moved into free space, climbs to the best
// place near it.
FitResult RefineOrClimb(const Observation& fitted, const Observation& judging, Solid* solid,
                        RayEvidence* evidence, FitBuffers* buffers);

}  // namespace declutter
