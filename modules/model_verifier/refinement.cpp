#include "modules/model_verifier/refinement.h"

#include <utility>

#include "modules/model_verifier/box_refinement.h"
#include "modules/model_verifier/cylinder_refinement.h"

namespace declutter {

Solid Refine(const Solid& solid, const Observation& observation) {
  return solid.shape == Shape::kBox ? RefineBox(solid, observation)
                                    : RefineCylinder(solid, observation);
}

void RefineIfNoWorse(const Observation& fitted, const Observation& judging, Solid* solid,
                     RayEvidence* evidence) {
  constexpr double kMaxLoss = 0.02;  // of the explained pixels: noise of the balance
  const Solid refined = Refine(*solid, fitted);
  RayEvidence refined_evidence = CastRays(refined, judging);
  if (refined_evidence.Balance() < evidence->Balance() - kMaxLoss * evidence->num_explained()) {
    if (solid->shape == Shape::kCylinder) ClimbCylinder(judging, solid, evidence);
    return;
  }
  const bool has_moved = refined.size != solid->size;
  *solid = refined;
  *evidence = std::move(refined_evidence);
  if (!has_moved && solid->shape == Shape::kCylinder) ClimbCylinder(judging, solid, evidence);
}

}  // namespace declutter
