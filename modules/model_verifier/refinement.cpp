#include "modules/model_verifier/refinement.h"

#include <utility>

#include "modules/model_verifier/box_refinement.h"
#include "modules/model_verifier/cylinder_refinement.h"
#include "modules/model_verifier/systematic_misfit.h"

namespace declutter {

Solid Refine(const Solid& solid, const Observation& observation, FitPoints* buffer) {
  return solid.shape == Shape::kBox ? RefineBox(solid, observation, buffer)
                                    : RefineCylinder(solid, observation, buffer);
}

bool RefineIfNoWorse(const Observation& fitted, const Observation& judging, Solid* solid,
                     RayEvidence* evidence, FitBuffers* buffers) {
  constexpr double kMaxLoss = 0.02;  // of the explained pixels: noise of the balance
  const Solid refined = Refine(*solid, fitted, &buffers->points);
  if (refined.size == solid->size && refined.X_CO.matrix() == solid->X_CO.matrix()) return false;
  CastRays(refined, judging, &buffers->evidence);
  if (buffers->evidence.Balance() < evidence->Balance() - kMaxLoss * evidence->num_explained()) {
    return false;
  }
  *solid = refined;
  std::swap(*evidence, buffers->evidence);
  return true;
}

bool RefineOrClimb(const Observation& fitted, const Observation& judging, Solid* solid,
                   RayEvidence* evidence, FitBuffers* buffers) {
  const bool is_fitted = RefineIfNoWorse(fitted, judging, solid, evidence, buffers);
  if (is_fitted || solid->shape != Shape::kCylinder) return is_fitted;
  const Solid before = *solid;
  ClimbCylinder(judging, solid, evidence, &buffers->evidence);
  const double misfit = MisfitShareOf(*solid, *evidence, judging, &buffers->explained_O);
  if (misfit == 0) return false;
  // It may have climbed onto its neighbours' points.
  CastRays(before, judging, &buffers->evidence);
  const double misfit_before =
      MisfitShareOf(before, buffers->evidence, judging, &buffers->explained_O);
  if ((1 - misfit) * evidence->Balance() < (1 - misfit_before) * buffers->evidence.Balance()) {
    *solid = before;
    std::swap(*evidence, buffers->evidence);
  }
  return false;
}

}  // namespace declutter
