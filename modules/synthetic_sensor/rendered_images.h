#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "modules/geometry/depth_image.h"
#include "modules/synthetic_sensor/synthetic_sensor.pb.h"

namespace declutter {

// What a synthetic sensor shows: depth images with noise of their own, one colour image.
struct RenderedImages {
  std::vector<DepthImage> depth;
  ColorImage color;  // registered to depth
};

// Renders the scene of the sensor described in the file at `path`; the depth images are those of
// scene_renderer with the sensor's seed, as frame 0, 1, ... Throws std::invalid_argument when the
// scene cannot be read or rendered; what() names the file, with line and column where there is one.
RenderedImages RenderImages(const SyntheticSensor& sensor, const std::string& path);

// A part of the sensor's image as a stream shows it.
struct ImageWindow {
  int step = 1;  // every step-th row and column
  bool is_mirrored = false;
  int x = 0, y = 0, width = 0, height = 0;  // [px] of the thinned, mirrored image

  // Column and row of the sensor's image, sensor_width wide, that pixel (u, v) of the window shows.
  int Column(int u, int sensor_width) const {
    const int column = step * (x + u);
    return is_mirrored ? sensor_width - 1 - column : column;
  }
  int Row(int v) const { return step * (y + v); }
};

// The window's pixels, row by row, into out, which has room for them.
void CopyDepth(const DepthImage& image, const ImageWindow& window, uint16_t* out);
void CopyColor(const ColorImage& image, const ImageWindow& window, uint8_t* out);

}  // namespace declutter
