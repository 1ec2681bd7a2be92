#include "modules/synthetic_sensor/rendered_images.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "modules/scene_renderer/scene_renderer.h"
#include "modules/scene_renderer/scene_text.h"

namespace declutter {
RenderedImages RenderImages(const SyntheticSensor& sensor, const std::string& path) {
  const std::string scene_path = std::filesystem::path(path).parent_path() / sensor.scene();
  const Scene scene = ReadScene(scene_path);
  RenderedImages images;
  try {
    for (int i = 0; i < sensor.num_images(); ++i) {
      RenderedScene rendered = Render(scene, sensor.seed(), static_cast<uint64_t>(i));
      images.depth.push_back(std::move(rendered.depth));
      images.color = std::move(rendered.color);
    }
  } catch (const std::invalid_argument& fault) {
    throw std::invalid_argument(scene_path + ": " + fault.what());
  }
  return images;
}

void CopyDepth(const DepthImage& image, const ImageWindow& window, uint16_t* out) {
  for (int v = 0; v < window.height; ++v) {
    for (int u = 0; u < window.width; ++u) {
      *out++ = image.CountAt(window.Column(u, image.camera.width), window.Row(v));
    }
  }
}

void CopyColor(const ColorImage& image, const ImageWindow& window, uint8_t* out) {
  for (int v = 0; v < window.height; ++v) {
    for (int u = 0; u < window.width; ++u) {
      const int pixel = window.Row(v) * image.width + window.Column(u, image.width);
      out = std::copy_n(image.rgb.begin() + 3 * pixel, 3, out);
    }
  }
}

}  // namespace declutter
