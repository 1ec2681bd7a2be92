#include "modules/model_verifier/refinement.h"

#include <utility>

#include "modules/model_verifier/box_refinement.h"
#include "modules/model_verifier/cylinder_refinement.h"
#include "modules/model_verifier/systematic_misfit.h"

namespace declutter {
namespace {

// [px] that speak for a solid less those that speak against it, as it may be another shape.
double NetFit(const RayEvidence& evidence, double misfit_share) {
  return evidence.Balance() - misfit_share * evidence.Fit();
}

double MisfitShareOf(const Solid& solid, const RayEvidence& evidence, const Observation& judging,
                     FitBuffers* buffers) {
  return MisfitShareOf(solid, evidence, judging, &buffers->explained_O);
}

}  // namespace

Solid Refine(const Solid& solid, const Observation& observation, FitPoints* buffer) {
  return solid.shape == Shape::kBox ? RefineBox(solid, observation, buffer)
                                    : RefineCylinder(solid, observation, buffer);
}

FitResult RefineIfNoWorse(const Observation& fitted, const Observation& judging, Solid* solid,
                          RayEvidence* evidence, FitBuffers* buffers) {
  constexpr double kMaxLoss = 0.02;  // of the explained pixels: noise of the balance
  const Solid refined = Refine(*solid, fitted, &buffers->points);
  if (refined.size == solid->size && refined.X_CO.matrix() == solid->X_CO.matrix()) return {};
  CastRays(refined, judging, &buffers->evidence);
  const double max_loss = kMaxLoss * evidence->num_explained();
  if (buffers->evidence.Balance() < evidence->Balance() - max_loss) return {};
  const double misfit_share = MisfitShareOf(refined, buffers->evidence, judging, buffers);
  // The fit may have moved it onto its neighbours' points.
  if (misfit_share > 0) {
    const double share_before = MisfitShareOf(*solid, *evidence, judging, buffers);
    if (NetFit(buffers->evidence, misfit_share) < NetFit(*evidence, share_before) - max_loss) {
      return {false, share_before};
    }
  }
  *solid = refined;
  std::swap(*evidence, buffers->evidence);
  return {true, misfit_share};
}

FitResult RefineOrClimb(const Observation& fitted, const Observation& judging, Solid* solid,
                        RayEvidence* evidence, FitBuffers* buffers) {
  // Of the explained pixels: more of free space inside, and a fit to the side has gone astray.
  constexpr double kMaxAstray = 0.1;
  const FitResult fit = RefineIfNoWorse(fitted, judging, solid, evidence, buffers);
  const int num_against = evidence->num_violating + evidence->num_contradicting;
  if (solid->shape != Shape::kCylinder ||
      (fit.is_fitted && num_against < kMaxAstray * evidence->num_explained())) {
    return fit;
  }
  const Solid before = *solid;
  ClimbCylinder(judging, solid, evidence, &buffers->evidence);
  const double misfit_share = MisfitShareOf(*solid, *evidence, judging, buffers);
  if (misfit_share > 0) {
    CastRays(before, judging, &buffers->evidence);
    const double share_before = fit.misfit_share
                                    ? *fit.misfit_share
                                    : MisfitShareOf(before, buffers->evidence, judging, buffers);
    if (NetFit(*evidence, misfit_share) < NetFit(buffers->evidence, share_before)) {
      *solid = before;
      std::swap(*evidence, buffers->evidence);
      return {fit.is_fitted, share_before};
    }
  }
  return {fit.is_fitted, misfit_share};
}

}  // namespace declutter
