#include "modules/model_verifier/pixel_grid.h"

#include <algorithm>

namespace declutter {

void PixelGrid::Set(const DepthImage& image, int new_step) {
  const PinholeCamera& camera = image.camera;
  step = new_step;
  columns = (camera.width + step - 1) / step;
  rows = (camera.height + step - 1) / step;
  stride = static_cast<size_t>(columns) + kPadding;
  ray_x.assign(stride, 0);
  ray_y.assign(static_cast<size_t>(rows), 0);
  z.resize(stride * static_cast<size_t>(rows));
  for (int i = 0; i < columns; ++i) {
    ray_x[static_cast<size_t>(i)] = static_cast<float>(camera.Ray(i * step, 0).x());
  }
  const auto scale = static_cast<float>(image.depth_scale_m);
  for (int j = 0; j < rows; ++j) {
    ray_y[static_cast<size_t>(j)] = static_cast<float>(camera.Ray(0, j * step).y());
    const uint16_t* counts =
        &image.counts[static_cast<size_t>(j) * static_cast<size_t>(step * camera.width)];
    float* depths = &z[static_cast<size_t>(j) * stride];
    if (step == 1) {  // by vector instructions
      for (int i = 0; i < columns; ++i) depths[i] = scale * static_cast<float>(counts[i]);
    } else {
      for (int i = 0; i < columns; ++i) depths[i] = scale * static_cast<float>(counts[i * step]);
    }
    std::fill_n(depths + columns, kPadding, 0.0f);
  }
}

}  // namespace declutter
