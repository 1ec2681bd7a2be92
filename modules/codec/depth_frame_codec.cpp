#include "modules/codec/depth_image_parts.h"

namespace declutter::codec {

depth_frame_t Encode(const DepthFrame& frame) {
  DemandConsistent(frame.header, frame.image);
  depth_frame_t message{};
  WriteHeader(frame.header, &message);
  WriteCamera(frame.image.camera, &message);
  WriteCameraPose(frame.X_WC, &message);
  WriteDepth(frame.image.depth_scale_m, frame.image.counts, &message);
  return Fitting(std::move(message));
}

DepthFrame Decode(const depth_frame_t& message) {
  DepthFrame frame;
  frame.header = ReadHeader(message);
  frame.image = ReadDepthImage(message);
  frame.X_WC = ReadCameraPose(message);
  return frame;
}

}  // namespace declutter::codec
