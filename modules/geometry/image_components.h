#pragma once

#include <cstdint>
#include <vector>

namespace declutter {

// Connected components of the marked pixels of an image.
struct ImageComponents {
  std::vector<int32_t> label;       // per pixel: 0 .. num_pixels.size() - 1, in row-major order of
                                    // first pixels; -1 where not marked
  std::vector<int32_t> num_pixels;  // per component
};

// Joins marked pixels that touch (8 neighbours) and whose values differ by at most max_step. mask
// and values are row-major, width * height long.
ImageComponents LabelComponents(int width, int height, const std::vector<uint8_t>& mask,
                                const std::vector<float>& values, float max_step);

}  // namespace declutter
