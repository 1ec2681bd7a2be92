#include "modules/object_exporter/sensor_size.h"

namespace declutter {
namespace {

template <typename Pixel>
std::vector<Pixel> Repeated(const std::vector<Pixel>& pixels, int width,
                            const Decimation& decimation) {
  std::vector<Pixel> repeated;
  repeated.reserve(static_cast<size_t>(decimation.sensor_width) *
                   static_cast<size_t>(decimation.sensor_height));
  for (int v = 0; v < decimation.sensor_height; ++v) {
    const auto row = static_cast<size_t>(v / decimation.step) * static_cast<size_t>(width);
    for (int u = 0; u < decimation.sensor_width; ++u) {
      repeated.push_back(pixels[row + static_cast<size_t>(u / decimation.step)]);
    }
  }
  return repeated;
}

}  // namespace

ObjectList AtSensorSize(ObjectList list, const Decimation& decimation) {
  list.labels = Repeated(list.labels, list.camera.width, decimation);
  list.camera = decimation.SensorCamera(list.camera);
  return list;
}

DepthImage AtSensorSize(DepthImage image, const Decimation& decimation) {
  image.counts = Repeated(image.counts, image.camera.width, decimation);
  image.camera = decimation.SensorCamera(image.camera);
  return image;
}

PicturedFrame AtSensorSize(const ObjectList& list, const DepthFrame* frame) {
  if (frame == nullptr) return {list, std::nullopt};
  const PinholeCamera& camera = frame->image.camera;
  const bool is_of_list = camera.width == list.camera.width && camera.height == list.camera.height;
  if (!frame->decimation || !is_of_list) return {list, frame->image};
  return {AtSensorSize(list, *frame->decimation), AtSensorSize(frame->image, *frame->decimation)};
}

}  // namespace declutter
