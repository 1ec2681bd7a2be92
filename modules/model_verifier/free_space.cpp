#include "modules/model_verifier/free_space.h"

namespace declutter {

int NumSeenThrough(const Solid& solid, const Observation& observation, RayEvidence* buffer) {
  constexpr double kDepth = 0.005;  // [m]
  Solid core = solid;
  core.size.array() -= 2 * kDepth;
  if (core.size.minCoeff() <= 0) return 0;
  CastRays(core, observation, buffer);
  return buffer->num_violating;
}

}  // namespace declutter
