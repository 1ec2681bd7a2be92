#include "modules/frame_views/contact_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace declutter {
namespace {

using imaging::Canvas;
using imaging::Rgb;

constexpr int kGap_px = 6;
constexpr int kTextScale = 1;
constexpr Rgb kPaper = {24, 24, 28};
constexpr Rgb kInk = {230, 230, 230};

int CellWidth(const ContactSheet::Layout& layout) { return layout.width_px + kGap_px; }
int CellHeight(const ContactSheet::Layout& layout) {
  return layout.height_px + Canvas::TextHeight(kTextScale) + 2 * kGap_px;
}

Canvas EmptyPage(const ContactSheet::Layout& layout) {
  const int width = layout.num_columns * CellWidth(layout) + kGap_px;
  const int height = layout.num_rows * CellHeight(layout) + kGap_px;
  ColorImage image{width, height, {}};
  image.rgb.resize(3 * static_cast<size_t>(width) * static_cast<size_t>(height));
  Canvas canvas(std::move(image));
  canvas.FillRectangle(0, 0, width, height, kPaper);
  return canvas;
}

// As much of a name as fits, from its end: names of frames differ there.
std::string Shortened(const std::string& name, int width_px) {
  std::string text = name;
  while (Canvas::TextWidth(text, kTextScale) > width_px) text.erase(0, 1);
  return text;
}

}  // namespace

std::optional<ColorImage> ContactSheet::Add(const std::string& name, const ColorImage& image) {
  if (!page_) page_ = EmptyPage(layout_);
  const int u = kGap_px + num_on_page_ % layout_.num_columns * CellWidth(layout_);
  const int v = kGap_px + num_on_page_ / layout_.num_columns * CellHeight(layout_);
  page_->DrawImage(u, v, ShrinkToFit(image, layout_.width_px, layout_.height_px));
  page_->DrawText(u, v + layout_.height_px + kGap_px, Shortened(name, layout_.width_px), kTextScale,
                  kInk);
  if (++num_on_page_ < layout_.num_columns * layout_.num_rows) return std::nullopt;
  return TakeRest();
}

std::optional<ColorImage> ContactSheet::TakeRest() {
  if (!page_) return std::nullopt;
  ColorImage image = page_->image();
  const int num_rows = (num_on_page_ + layout_.num_columns - 1) / layout_.num_columns;
  image.height = num_rows * CellHeight(layout_) + kGap_px;
  image.rgb.resize(3 * static_cast<size_t>(image.width) * static_cast<size_t>(image.height));
  page_.reset();
  num_on_page_ = 0;
  return image;
}

ColorImage ShrinkToFit(const ColorImage& image, int width_px, int height_px) {
  const double scale = std::min({1.0, static_cast<double>(width_px) / std::max(1, image.width),
                                 static_cast<double>(height_px) / std::max(1, image.height)});
  if (scale == 1.0) return image;
  ColorImage small{std::max(1, static_cast<int>(std::lround(scale * image.width))),
                   std::max(1, static_cast<int>(std::lround(scale * image.height))),
                   {}};
  small.rgb.reserve(3 * static_cast<size_t>(small.width) * static_cast<size_t>(small.height));
  for (int v = 0; v < small.height; ++v) {
    const int top = v * image.height / small.height;
    const int bottom = std::max(top + 1, (v + 1) * image.height / small.height);
    for (int u = 0; u < small.width; ++u) {
      const int left = u * image.width / small.width;
      const int right = std::max(left + 1, (u + 1) * image.width / small.width);
      std::array<int, 3> sum = {};
      for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x) {
          const size_t first = 3 * (static_cast<size_t>(y) * static_cast<size_t>(image.width) +
                                    static_cast<size_t>(x));
          for (size_t c = 0; c < 3; ++c) sum[c] += image.rgb[first + c];
        }
      }
      const int num = (bottom - top) * (right - left);
      for (const int value : sum)
        small.rgb.push_back(static_cast<uint8_t>((value + num / 2) / num));
    }
  }
  return small;
}

}  // namespace declutter
