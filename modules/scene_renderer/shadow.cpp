#include "modules/scene_renderer/shadow.h"

#include <algorithm>
#include <random>

namespace declutter {
namespace {

// Marks the pixels of a row that a viewer at x = offset_m of C cannot see. Its image is rectified
// with ours, so a point of column u is at u - fx * offset / z there and surfaces keep their order:
// going away from the viewer's side, a column that falls back behind one already met is hidden.
void CastShadows(const IdealImage& ideal, int v, double offset_m, std::vector<uint8_t>* hidden) {
  const int width = ideal.camera.width;
  const size_t row = static_cast<size_t>(v) * static_cast<size_t>(width);
  const double side = offset_m > 0 ? 1 : -1;
  double nearest = 1e9;
  for (int i = 0; i < width; ++i) {
    const int u = offset_m > 0 ? width - 1 - i : i;
    const size_t pixel = row + static_cast<size_t>(u);
    const bool seen = ideal.solid[pixel] >= 0;
    const double shift_px =
        seen ? ideal.camera.fx * offset_m / static_cast<double>(ideal.z[pixel]) : 0.0;
    const double column = side * (u - shift_px);
    (*hidden)[static_cast<size_t>(u)] = seen && column >= nearest;
    if (seen) nearest = std::min(nearest, column);
  }
}

// Clears the ends of the shadows that are away from what casts them.
void CloseShadows(double offset_m, std::uniform_int_distribution<int> closing,
                  std::mt19937_64* random, std::vector<uint8_t>* hidden) {
  const int width = static_cast<int>(hidden->size());
  int left_to_clear = 0;
  bool in_shadow = false;
  for (int i = 0; i < width; ++i) {
    const int u = offset_m > 0 ? i : width - 1 - i;
    uint8_t& value = (*hidden)[static_cast<size_t>(u)];
    if (value && !in_shadow) left_to_clear = closing(*random);
    in_shadow = value != 0;
    if (in_shadow && left_to_clear-- > 0) value = 0;
  }
}

// Adds to the mask what one viewer cannot see.
void AddShadows(const IdealImage& ideal, double offset_m, int min_closing_px, int max_closing_px,
                std::mt19937_64* random, std::vector<uint8_t>* mask) {
  if (offset_m == 0) return;
  const std::uniform_int_distribution<int> closing(min_closing_px,
                                                   std::max(min_closing_px, max_closing_px));
  const size_t width = static_cast<size_t>(ideal.camera.width);
  std::vector<uint8_t> hidden(width);
  for (int v = 0; v < ideal.camera.height; ++v) {
    CastShadows(ideal, v, offset_m, &hidden);
    CloseShadows(offset_m, closing, random, &hidden);
    uint8_t* row = mask->data() + static_cast<size_t>(v) * width;
    for (size_t u = 0; u < width; ++u) row[u] |= hidden[u];
  }
}

}  // namespace

std::vector<uint8_t> ShadowMask(const IdealImage& ideal, const SceneNoise& noise, uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<uint8_t> mask(ideal.z.size(), 0);
  AddShadows(ideal, noise.projector_x_m(), noise.min_projector_closing_px(),
             noise.max_projector_closing_px(), &random, &mask);
  AddShadows(ideal, noise.infrared_camera_x_m(), noise.min_infrared_closing_px(),
             noise.max_infrared_closing_px(), &random, &mask);
  return mask;
}

}  // namespace declutter
