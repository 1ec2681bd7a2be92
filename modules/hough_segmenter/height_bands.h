#pragma once

#include <vector>

#include "modules/geometry/image_components.h"

namespace declutter {

// [m] heights that part the faces in a sample of heights, ascending: valleys of their distribution
// to half of the peaks beside them, when it is smoothed by the noise of one height, sigma. Between
// two of them, and beyond, are at least min_num heights.
std::vector<float> HeightsBetweenFaces(const std::vector<float>& heights, float sigma, int min_num);

// Parts the patches that join faces of different heights: noise bridges a step between neighbouring
// pixels, but not one between whole faces. heights [m] are row-major, columns * rows long. Patches
// are numbered anew.
void SplitAtHeights(int columns, int rows, const std::vector<float>& heights, float max_step_m,
                    int min_pixels, ImageComponents* patches);

}  // namespace declutter
