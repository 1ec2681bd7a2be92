#pragma once

#include <optional>

#include "modules/geometry/depth_image.h"
#include "modules/geometry/solid.h"

// Images of a decimated frame at the size of the sensor's: every pixel becomes step x step pixels,
// fewer at the right and lower edge.
namespace declutter {

// list.labels and list.camera.
ObjectList AtSensorSize(ObjectList list, const Decimation& decimation);

DepthImage AtSensorSize(DepthImage image, const Decimation& decimation);

// What the pictures of a frame show.
struct PicturedFrame {
  ObjectList list;
  std::optional<DepthImage> depth;
};

// frame: of the same utime; null when there is none.
PicturedFrame AtSensorSize(const ObjectList& list, const DepthFrame* frame);

}  // namespace declutter
