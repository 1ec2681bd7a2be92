#pragma once

#include <cstdint>
#include <vector>

#include "modules/scene_renderer/ray_caster.h"
#include "modules/scene_renderer/scene.pb.h"

namespace declutter {

// Pixels of the image that cannot be measured because a nearer surface hides them from the
// projector or from the infrared camera, both beside C on its x axis: 1, else 0; row-major.
// A shadow is narrower than geometry says by some columns at its far end, where part of the
// matching window is lit; how many is drawn from `seed` for each row of each shadow.
std::vector<uint8_t> ShadowMask(const IdealImage& ideal, const SceneNoise& noise, uint64_t seed);

}  // namespace declutter
