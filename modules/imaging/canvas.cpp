#include "modules/imaging/canvas.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "modules/imaging/glyphs.h"

namespace declutter::imaging {
namespace {

constexpr int kGlyphAdvance = kGlyphWidth + 1;

// First and last pixel that a span reaches within 0 .. size - 1; empty when first > last.
std::pair<int, int> PixelSpan(double from, double to, double margin, int size) {
  const double first = std::floor(std::min(from, to) - margin);
  const double last = std::ceil(std::max(from, to) + margin);
  return {static_cast<int>(std::clamp(first, 0.0, static_cast<double>(size))),
          static_cast<int>(std::clamp(last, -1.0, static_cast<double>(size - 1)))};
}

}  // namespace

Canvas::Canvas(ColorImage image) : image_(std::move(image)) {
  const auto num_pixels = static_cast<size_t>(image_.width) * static_cast<size_t>(image_.height);
  if (image_.rgb.size() != 3 * num_pixels) {
    throw std::logic_error("canvas: the image's size and its number of pixels disagree");
  }
}

void Canvas::Blend(int u, int v, const Rgb& color, double opacity) {
  if (u < 0 || v < 0 || u >= image_.width || v >= image_.height) return;
  const size_t first =
      3 * (static_cast<size_t>(v) * static_cast<size_t>(image_.width) + static_cast<size_t>(u));
  for (size_t i = 0; i < 3; ++i) {
    uint8_t& channel = image_.rgb[first + i];
    channel = static_cast<uint8_t>(std::lround((1 - opacity) * channel + opacity * color[i]));
  }
}

void Canvas::DrawLine(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double thickness_px,
                      const Rgb& color, double opacity) {
  if (!from.allFinite() || !to.allFinite()) return;
  const Eigen::Vector2d along = to - from;
  const double length2 = along.squaredNorm();
  const double margin = thickness_px / 2 + 0.5;
  const auto [first_u, last_u] = PixelSpan(from.x(), to.x(), margin, image_.width);
  const auto [first_v, last_v] = PixelSpan(from.y(), to.y(), margin, image_.height);
  for (int v = first_v; v <= last_v; ++v) {
    for (int u = first_u; u <= last_u; ++u) {
      const Eigen::Vector2d offset = Eigen::Vector2d(u, v) - from;
      const double t = length2 > 0 ? std::clamp(offset.dot(along) / length2, 0.0, 1.0) : 0;
      const double coverage = std::min(1.0, margin - (offset - t * along).norm());
      if (coverage > 0) Blend(u, v, color, opacity * coverage);
    }
  }
}

void Canvas::FillRectangle(int u, int v, int width, int height, const Rgb& color, double opacity) {
  for (int row = std::max(v, 0); row < std::min(v + height, image_.height); ++row) {
    for (int column = std::max(u, 0); column < std::min(u + width, image_.width); ++column) {
      Blend(column, row, color, opacity);
    }
  }
}

void Canvas::DrawImage(int u, int v, const ColorImage& image) {
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      const size_t first = 3 * (static_cast<size_t>(row) * static_cast<size_t>(image.width) +
                                static_cast<size_t>(column));
      Blend(u + column, v + row, {image.rgb[first], image.rgb[first + 1], image.rgb[first + 2]}, 1);
    }
  }
}

void Canvas::DrawText(int u, int v, const std::string& text, int scale, const Rgb& color) {
  for (const char character : text) {
    const auto& glyph = GlyphOf(character);
    for (int row = 0; row < kGlyphHeight; ++row) {
      for (int column = 0; column < kGlyphWidth; ++column) {
        if ((glyph[static_cast<size_t>(row)] >> (kGlyphWidth - 1 - column) & 1) == 0) continue;
        FillRectangle(u + column * scale, v + row * scale, scale, scale, color);
      }
    }
    u += kGlyphAdvance * scale;
  }
}

int Canvas::TextWidth(const std::string& text, int scale) {
  return text.empty() ? 0 : (static_cast<int>(text.size()) * kGlyphAdvance - 1) * scale;
}

int Canvas::TextHeight(int scale) { return kGlyphHeight * scale; }

}  // namespace declutter::imaging
