#include <algorithm>
#include <optional>

#include "modules/codec/depth_image_parts.h"
#include "modules/geometry/image_limits.h"

namespace declutter::codec {
namespace {

constexpr int kMaxEncodedStep = 4;
constexpr int32_t kMaxStep = 16;
// [m] that depths may be rounded to: a quarter of a sensor's noise at 1 m, as much as it at 0.5 m.
constexpr double kRounding = 0.0005;

// Size of one side after decimation.
int KeptSide(int side, int step) { return (side + step - 1) / step; }

DepthImage Kept(const DepthImage& image, int step) {
  const PinholeCamera& camera = image.camera;
  DepthImage kept;
  kept.camera = {KeptSide(camera.width, step),
                 KeptSide(camera.height, step),
                 camera.fx / step,
                 camera.fy / step,
                 camera.cx / step,
                 camera.cy / step};
  kept.depth_scale_m = image.depth_scale_m;
  kept.counts.reserve(static_cast<size_t>(kept.camera.num_pixels()));
  for (int v = 0; v < camera.height; v += step) {
    for (int u = 0; u < camera.width; u += step) kept.counts.push_back(image.CountAt(u, v));
  }
  return kept;
}

DepthFrame Decimated(const DepthFrame& frame, int step) {
  const PinholeCamera& camera = frame.image.camera;
  const Decimation before = frame.decimation.value_or(Decimation{1, camera.width, camera.height});
  return {frame.header, Kept(frame.image, step), frame.X_WC,
          Decimation{before.step * step, before.sensor_width, before.sensor_height}};
}

// The same frame in larger counts; nothing where they would be coarser than the rounding.
std::optional<DepthFrame> Rounded(const DepthFrame& frame) {
  const auto factor = static_cast<int>(kRounding / frame.image.depth_scale_m * (1 + 1e-9));
  if (factor < 2) return std::nullopt;
  DepthFrame rounded = frame;
  rounded.image.depth_scale_m *= factor;
  for (uint16_t& count : rounded.image.counts) {
    if (count > 0) count = static_cast<uint16_t>(std::max(1, (count + factor / 2) / factor));
  }
  return rounded;
}

void DemandConsistent(const DepthFrame& frame) {
  codec::DemandConsistent(frame.header, frame.image);
  if (!frame.decimation) return;
  const auto [step, sensor_width, sensor_height] = *frame.decimation;
  Demand(step >= 1 && step <= kMaxStep, "decimation " + std::to_string(step));
  Demand(KeptSide(sensor_width, step) == frame.image.camera.width &&
             KeptSide(sensor_height, step) == frame.image.camera.height,
         "depth image and sensor differ in size by more than the decimation");
}

depth_frame_t Write(const DepthFrame& frame) {
  const PinholeCamera& camera = frame.image.camera;
  const Decimation decimation =
      frame.decimation.value_or(Decimation{1, camera.width, camera.height});
  depth_frame_t message{};
  WriteHeader(frame.header, &message);
  WriteCamera(camera, &message);
  message.decimation = decimation.step;
  message.sensor_width = decimation.sensor_width;
  message.sensor_height = decimation.sensor_height;
  WriteCameraPose(frame.X_WC, &message);
  WriteDepth(frame.image.depth_scale_m, frame.image.counts, &message);
  return message;
}

void CheckSensorSide(const char* name, int32_t sensor_side, int32_t side, int32_t step) {
  Check(sensor_side >= 0 && sensor_side <= kMaxImageSide_px && KeptSide(sensor_side, step) == side,
        name, sensor_side, "is not the sensor's size of an image so decimated");
}

std::optional<Decimation> ReadDecimation(const depth_frame_t& message) {
  const int32_t step = message.decimation;
  Check(step >= 1 && step <= kMaxStep, "decimation", step, "must be in 1 .. 16");
  CheckSensorSide("sensor_width", message.sensor_width, message.width, step);
  CheckSensorSide("sensor_height", message.sensor_height, message.height, step);
  if (step == 1) return std::nullopt;
  return Decimation{step, message.sensor_width, message.sensor_height};
}

}  // namespace

depth_frame_t Encode(const DepthFrame& frame) {
  DemandConsistent(frame);
  depth_frame_t message = Write(frame);
  const auto fits = [&] { return message.getEncodedSize() <= kMaxMessageBytes; };
  if (fits()) return message;
  const std::optional<DepthFrame> rounded = Rounded(frame);
  if (rounded) message = Write(*rounded);
  for (int step = 2; !fits() && step <= kMaxEncodedStep; ++step) {
    message = Write(Decimated(rounded ? *rounded : frame, step));
  }
  return Fitting(std::move(message));
}

DepthFrame Decode(const depth_frame_t& message) {
  DepthFrame frame;
  frame.header = ReadHeader(message);
  frame.image = ReadDepthImage(message);
  frame.X_WC = ReadCameraPose(message);
  frame.decimation = ReadDecimation(message);
  return frame;
}

}  // namespace declutter::codec
