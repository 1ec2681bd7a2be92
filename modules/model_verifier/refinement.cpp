#include "modules/model_verifier/refinement.h"

#include <utility>

#include "modules/model_verifier/box_refinement.h"
#include "modules/model_verifier/cylinder_refinement.h"

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

bool RefineToRest(const Observation& fitted, const Observation& judging, Solid* solid,
                  RayEvidence* evidence, FitBuffers* buffers) {
  constexpr int kMaxFits = 2;     // the third moves by micrometres
  constexpr double kRest = 5e-6;  // [m]
  bool has_moved = false;
  for (int i = 0; i < kMaxFits; ++i) {
    const Solid before = *solid;
    if (!RefineIfNoWorse(fitted, judging, solid, evidence, buffers)) break;
    has_moved = true;
    if ((solid->size - before.size).cwiseAbs().maxCoeff() < kRest &&
        (solid->X_CO.translation() - before.X_CO.translation()).cwiseAbs().maxCoeff() < kRest) {
      break;
    }
  }
  return has_moved;
}

}  // namespace declutter
