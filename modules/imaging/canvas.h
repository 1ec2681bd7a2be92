#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>

#include "modules/geometry/depth_image.h"

namespace declutter::imaging {

using Rgb = std::array<uint8_t, 3>;

// Draws over an image. Pixel (u, v) has its centre at (u, v); what falls outside the image is not
// drawn. Opacity is in [0, 1].
class Canvas {
 public:
  // image.rgb must hold 3 * width * height values.
  explicit Canvas(ColorImage image);

  void Blend(int u, int v, const Rgb& color, double opacity);

  // A straight line with smooth edges and round ends.
  void DrawLine(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double thickness_px,
                const Rgb& color, double opacity = 1);

  // Pixels u .. u + width - 1, v .. v + height - 1.
  void FillRectangle(int u, int v, int width, int height, const Rgb& color, double opacity = 1);

  // Another image with its upper left pixel at (u, v).
  void DrawImage(int u, int v, const ColorImage& image);

  // Capitals of 5 x 7 dots, `scale` pixels each, upper left dot at (u, v). Small letters are drawn
  // as capitals, characters without a glyph as an empty box.
  void DrawText(int u, int v, const std::string& text, int scale, const Rgb& color);
  static int TextWidth(const std::string& text, int scale);  // [px]
  static int TextHeight(int scale);                          // [px]

  const ColorImage& image() const { return image_; }

 private:
  ColorImage image_;
};

}  // namespace declutter::imaging
