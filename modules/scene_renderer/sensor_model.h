#pragma once

#include <cstdint>

#include "modules/geometry/depth_image.h"
#include "modules/scene_renderer/ray_caster.h"
#include "modules/scene_renderer/scene.pb.h"

namespace declutter {

// What the depth sensor of a scene measures of an ideal image. The noise is in disparity,
// D = K / z counts, as structured light has it:
//   D averaged over the matching window within one object, plus
//   white noise filtered by a box, part of its variance equal in all frames of a seed, plus
//   a smooth field that belongs to the sensor; D rounded to counts, z to depth_scale_m;
// pixels hidden from the projector or the infrared camera, seen at a grazing angle, or picked at
// random have no depth. Models "white" and "none" are as the parameters say, without lost pixels.
// Same image, noise, seed and frame: same result.
DepthImage Sense(const IdealImage& ideal, const SceneNoise& noise, double depth_scale_m,
                 uint64_t seed, uint64_t frame);

// [m] standard deviation of a depth z, and the number of pixels beside each other whose errors are
// one. The smooth field of a sensor does not count. Not for the model "none".
double DepthSigma(const SceneNoise& noise, double z);
int PixelsPerSample(const SceneNoise& noise);

}  // namespace declutter
