#include "modules/model_verifier/refinement.h"

#include <utility>

#include "modules/model_verifier/box_refinement.h"
#include "modules/model_verifier/cylinder_refinement.h"

namespace declutter {

Solid Refine(const Solid& solid, const Observation& observation, SurfacePoints* buffer) {
  return solid.shape == Shape::kBox ? RefineBox(solid, observation, buffer)
                                    : RefineCylinder(solid, observation, buffer);
}

void RefineIfNoWorse(const Observation& fitted, const Observation& judging, Solid* solid,
                     RayEvidence* evidence, FitBuffers* buffers) {
  constexpr double kMaxLoss = 0.02;  // of the explained pixels: noise of the balance
  const auto climb = [&] {
    if (solid->shape == Shape::kCylinder) {
      ClimbCylinder(judging, solid, evidence, &buffers->evidence);
    }
  };
  const Solid refined = Refine(*solid, fitted, &buffers->points);
  CastRays(refined, judging, &buffers->evidence);
  if (buffers->evidence.Balance() < evidence->Balance() - kMaxLoss * evidence->num_explained()) {
    climb();
    return;
  }
  const bool has_moved = refined.size != solid->size;
  *solid = refined;
  std::swap(*evidence, buffers->evidence);
  if (!has_moved) climb();
}

}  // namespace declutter
