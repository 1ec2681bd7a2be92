#pragma once

#include "modules/codec/depth_compression.h"
#include "modules/codec/frame_parts.h"

// The depth image that depth_frame_t and tabletop_t carry under the same field names.
namespace declutter::codec {

inline void DemandConsistent(const FrameHeader& header, const DepthImage& image) {
  DemandImageSize(image.camera.width, image.camera.height, header.error);
  Demand(image.counts.size() == static_cast<size_t>(image.camera.num_pixels()),
         "depth image and camera differ in size");
}

// The camera is WriteCamera's.
template <typename Message>
void WriteDepth(double depth_scale_m, const std::vector<uint16_t>& counts, Message* message) {
  message->depth_scale_m = depth_scale_m;
  if (!counts.empty()) message->data = CompressDepth(counts);
  message->num_bytes = static_cast<int32_t>(message->data.size());
}

template <typename Message>
DepthImage ReadDepthImage(const Message& message) {
  CheckLength("data", message.data, "num_bytes", message.num_bytes);
  DepthImage image;
  image.camera = ReadCamera(message);
  const double scale = message.depth_scale_m;
  Check(scale > 0 && scale <= 1, "depth_scale_m", scale, "must be in (0, 1]");
  image.depth_scale_m = scale;
  const auto num_pixels = static_cast<size_t>(image.camera.num_pixels());
  if (num_pixels == 0) {
    Check(message.data.empty(), "num_bytes", message.num_bytes,
          "must be 0 in a frame with an error");
    return image;
  }
  auto counts = DecompressDepth(message.data, num_pixels);
  Check(counts.has_value(), "num_bytes", message.num_bytes,
        "data is not the coded depth of width * height pixels");
  image.counts = std::move(*counts);
  return image;
}

}  // namespace declutter::codec
