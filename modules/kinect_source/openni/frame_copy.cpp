#include "modules/kinect_source/openni/frame_copy.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "modules/kinect_source/sensor.h"

namespace declutter {
namespace {

struct Rgb {
  uint8_t r, g, b;
};

void CheckWhole(const openni::VideoFrameRef& frame, int bytes_per_pixel) {
  const int width = frame.getWidth(), height = frame.getHeight();
  const int stride = frame.getStrideInBytes(), size = frame.getDataSize();
  if (width > 0 && height > 0 && stride >= width * bytes_per_pixel &&
      size >= stride * (height - 1) + width * bytes_per_pixel) {
    return;
  }
  throw DamagedFrame("frame " + std::to_string(frame.getFrameIndex()) +
                     " of the sensor: " + std::to_string(size) + " byte are no image of " +
                     std::to_string(width) + "x" + std::to_string(height) + " px");
}

template <typename Pixel>
void CopyRows(const openni::VideoFrameRef& frame, bool is_mirrored, Pixel* out) {
  const auto width = static_cast<size_t>(frame.getWidth());
  const auto* row = static_cast<const uint8_t*>(frame.getData());
  for (int v = 0; v < frame.getHeight(); ++v) {
    std::memcpy(out, row, width * sizeof(Pixel));
    if (is_mirrored) std::reverse(out, out + width);
    row += frame.getStrideInBytes();
    out += width;
  }
}

}  // namespace

DepthImage CopyDepth(const openni::VideoFrameRef& frame, bool is_mirrored) {
  CheckWhole(frame, sizeof(uint16_t));
  DepthImage image;
  const bool is_fine = frame.getVideoMode().getPixelFormat() == openni::PIXEL_FORMAT_DEPTH_100_UM;
  image.depth_scale_m = is_fine ? 1e-4 : 1e-3;
  image.counts.resize(static_cast<size_t>(frame.getWidth()) *
                      static_cast<size_t>(frame.getHeight()));
  CopyRows(frame, is_mirrored, image.counts.data());
  return image;
}

ColorImage CopyColor(const openni::VideoFrameRef& frame, bool is_mirrored) {
  static_assert(sizeof(Rgb) == 3);
  CheckWhole(frame, sizeof(Rgb));
  ColorImage image{frame.getWidth(), frame.getHeight(), {}};
  std::vector<Rgb> pixels(static_cast<size_t>(image.width) * static_cast<size_t>(image.height));
  CopyRows(frame, is_mirrored, pixels.data());
  const auto* bytes = reinterpret_cast<const uint8_t*>(pixels.data());
  image.rgb.assign(bytes, bytes + 3 * pixels.size());
  return image;
}

}  // namespace declutter
