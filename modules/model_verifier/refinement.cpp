#include "modules/model_verifier/refinement.h"

#include <utility>

#include "modules/model_verifier/box_refinement.h"
#include "modules/model_verifier/cylinder_refinement.h"
#include "modules/model_verifier/systematic_misfit.h"

namespace declutter {
namespace {

// [px] that speak for a solid less those that speak against it, as its side may be another shape.
double NetFit(const Solid& solid, const RayEvidence& evidence, const Observation& judging,
              FitBuffers* buffers) {
  return evidence.Balance() -
         MisfitShareOf(solid, evidence, judging, &buffers->explained_O) * evidence.Fit();
}

}  // namespace

Solid Refine(const Solid& solid, const Observation& observation, FitPoints* buffer) {
  return solid.shape == Shape::kBox ? RefineBox(solid, observation, buffer)
                                    : RefineCylinder(solid, observation, buffer);
}

bool RefineIfNoWorse(const Observation& fitted, const Observation& judging, Solid* solid,
                     RayEvidence* evidence, FitBuffers* buffers) {
  constexpr double kMaxLoss = 0.02;     // of the explained pixels: noise of the balance
  constexpr double kMinGrowth = 0.005;  // [m] beyond what blurred edges make
  const Solid refined = Refine(*solid, fitted, &buffers->points);
  if (refined.size == solid->size && refined.X_CO.matrix() == solid->X_CO.matrix()) return false;
  CastRays(refined, judging, &buffers->evidence);
  const double max_loss = kMaxLoss * evidence->num_explained();
  if (buffers->evidence.Balance() < evidence->Balance() - max_loss) return false;
  // One that grew may have moved onto its neighbours' points.
  if ((refined.size - solid->size).maxCoeff() > kMinGrowth) {
    const double net_fit = NetFit(refined, buffers->evidence, judging, buffers);
    if (net_fit < buffers->evidence.Balance() &&
        net_fit < NetFit(*solid, *evidence, judging, buffers) - max_loss) {
      return false;
    }
  }
  *solid = refined;
  std::swap(*evidence, buffers->evidence);
  return true;
}

bool RefineOrClimb(const Observation& fitted, const Observation& judging, Solid* solid,
                   RayEvidence* evidence, FitBuffers* buffers) {
  // Of the explained pixels: more of free space inside, and a fit to the side has gone astray.
  constexpr double kMaxAstray = 0.1;
  const bool is_fitted = RefineIfNoWorse(fitted, judging, solid, evidence, buffers);
  const int num_against = evidence->num_violating + evidence->num_contradicting;
  if (solid->shape != Shape::kCylinder ||
      (is_fitted && num_against < kMaxAstray * evidence->num_explained())) {
    return is_fitted;
  }
  const Solid before = *solid;
  ClimbCylinder(judging, solid, evidence, &buffers->evidence);
  const double net_fit = NetFit(*solid, *evidence, judging, buffers);
  if (net_fit == evidence->Balance()) return is_fitted;
  CastRays(before, judging, &buffers->evidence);
  if (net_fit < NetFit(before, buffers->evidence, judging, buffers)) {
    *solid = before;
    std::swap(*evidence, buffers->evidence);
  }
  return is_fitted;
}

}  // namespace declutter
