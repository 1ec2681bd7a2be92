#pragma once

#include <cstdint>
#include <vector>

#include "modules/scene_renderer/scene.pb.h"

namespace declutter {

// Noise fields of a structured-light sensor in counts of disparity, row-major, width * height long.

// White noise filtered by a box, sigma 1, the same for the same seed.
std::vector<float> BoxNoise(int width, int height, int box_width, int box_height, uint64_t seed);

// The sensor's smooth field: half of its variance a quadratic of the pixel, half irregular,
// smoothed to correlation 0.5 at length_px. It has no constant or linear part, which would be a
// tilt of what is seen (the correlation at length_px falls below 0.5 by that); rms 1 over the
// image.
std::vector<float> SmoothField(int width, int height, double length_px, uint64_t seed);

}  // namespace declutter
