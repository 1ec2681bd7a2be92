#include "modules/model_verifier/free_space.h"

#include "modules/model_verifier/extents.h"

namespace declutter {

int NumSeenThrough(const Solid& solid, const Observation& observation, RayEvidence* buffer) {
  constexpr double kDepth = 0.005;  // [m]
  Solid core = Longer(solid, 2, 1, -kDepth);
  core.size.head<2>().array() -= 2 * kDepth;
  if (core.size.minCoeff() <= 0) return 0;
  CastRays(core, observation, buffer);
  return buffer->num_violating;
}

}  // namespace declutter
