#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "modules/geometry/depth_image.h"

// PNG files to images and back. What cannot be read or written throws std::runtime_error that names
// the file and what is wrong with it. Images over 8192 px on a side are refused.
namespace declutter::imaging {

// A grey image; pixels are row-major, width * height of them.
template <typename Pixel>
struct GrayImage {
  int width = 0;   // [px]
  int height = 0;  // [px]
  std::vector<Pixel> pixels;
};

// A 16-bit grey PNG, its samples untouched: no gamma, no scaling. Other kinds of PNG are refused.
GrayImage<uint16_t> ReadGray16Png(const std::string& path);

// An 8-bit grey PNG, its samples untouched. Other kinds of PNG are refused.
GrayImage<uint8_t> ReadGray8Png(const std::string& path);

// Any PNG as 8-bit RGB: grey and palette are expanded, 16 bits are scaled to 8, alpha is dropped.
ColorImage ReadRgbPng(const std::string& path);

// Replaces the file. A file that could not be written completely is removed.
void WriteGray8Png(const std::string& path, const GrayImage<uint8_t>& image);
void WriteGray16Png(const std::string& path, const GrayImage<uint16_t>& image);
void WriteRgbPng(const std::string& path, const ColorImage& image);

}  // namespace declutter::imaging
