#pragma once

#include <vector>

#include "modules/model_verifier/observation.h"

namespace declutter {

// How large the errors of a sensor are that many points of a surface share, as a multiple of those
// of a Kinect: by how much the support plane is seen wavy. 1 where too little of it is seen.
// deviations is a buffer.
double NoiseLevel(const Observation& every_pixel, std::vector<float>* deviations);

}  // namespace declutter
