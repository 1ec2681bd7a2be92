#include <turbojpeg.h>

#include <memory>

#include "modules/codec/checks.h"

namespace declutter::codec {
namespace {

constexpr int kFirstQuality = 85;
constexpr int kQualityStep = 10;
constexpr int kChroma = TJSAMP_420;

struct DestroyHandle {
  void operator()(void* handle) const { tjDestroy(handle); }
};
using Handle = std::unique_ptr<void, DestroyHandle>;

std::vector<uint8_t> CompressJpeg(void* handle, const ColorImage& image, int quality) {
  std::vector<uint8_t> jpeg(tjBufSize(image.width, image.height, kChroma));
  unsigned char* data = jpeg.data();
  unsigned long size = jpeg.size();
  const int failed = tjCompress2(handle, image.rgb.data(), image.width, 0, image.height, TJPF_RGB,
                                 &data, &size, kChroma, quality, TJFLAG_NOREALLOC);
  Demand(failed == 0, tjGetErrorStr2(handle));
  jpeg.resize(size);
  return jpeg;
}

}  // namespace

color_frame_t Encode(const FrameHeader& header, const ColorImage& image) {
  const size_t num_pixels = DemandImageSize(image.width, image.height, "");
  Demand(image.rgb.size() == 3 * num_pixels, "colour image and its size differ");
  color_frame_t message{};
  message.utime = header.utime;
  message.frame = header.frame;
  message.width = image.width;
  message.height = image.height;
  const Handle handle(tjInitCompress());
  for (int quality = kFirstQuality; quality > 0; quality -= kQualityStep) {
    message.jpeg = CompressJpeg(handle.get(), image, quality);
    message.num_bytes = static_cast<int32_t>(message.jpeg.size());
    if (message.getEncodedSize() <= kMaxMessageBytes) break;
  }
  return Fitting(std::move(message));
}

ColorImage Decode(const color_frame_t& message) {
  CheckLength("jpeg", message.jpeg, "num_bytes", message.num_bytes);
  const size_t num_pixels = CheckImageSize(message.width, message.height, "");
  const Handle handle(tjInitDecompress());
  const auto num_bytes = static_cast<unsigned long>(message.jpeg.size());
  int width = 0;
  int height = 0;
  int chroma = 0;
  int colors = 0;
  const bool is_jpeg = tjDecompressHeader3(handle.get(), message.jpeg.data(), num_bytes, &width,
                                           &height, &chroma, &colors) == 0;
  Check(is_jpeg, "num_bytes", message.num_bytes, "jpeg is not a JPEG file");
  Check(width == message.width, "width", message.width, "is not that of the JPEG file");
  Check(height == message.height, "height", message.height, "is not that of the JPEG file");
  ColorImage image{width, height, std::vector<uint8_t>(3 * num_pixels)};
  // A progressive file of a few bytes can make the decoder work for minutes.
  const int flags = TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS;
  const bool is_whole = tjDecompress2(handle.get(), message.jpeg.data(), num_bytes,
                                      image.rgb.data(), width, 0, height, TJPF_RGB, flags) == 0;
  Check(is_whole, "num_bytes", message.num_bytes, "jpeg is damaged");
  return image;
}

}  // namespace declutter::codec
