#pragma once

#include <vector>

#include "modules/plane_filter/inverse_depth.h"

namespace declutter {

// [1/m] standard deviation of 1 / z that a pixel does not share with its neighbours, over an image:
// that of most of its second differences along rows, which surfaces are too smooth to add to. 0 in
// an image with hardly a measurement. What neighbours share, as the noise of a disparity sensor, is
// more than this. buffer is used again.
double IndependentNoise(const InverseDepth& image, std::vector<float>* buffer);

}  // namespace declutter
