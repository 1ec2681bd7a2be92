#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "modules/geometry/depth_image.h"

namespace declutter {

// Time between frames of a recording that has no clock.
inline constexpr int64_t kFramePeriodUs = 33333;

// The images of one frame.
struct FrameContent {
  DepthImage depth;
  std::optional<ColorImage> color;  // registered to depth
  std::string color_error;          // why there is no colour image though there is a file
};

// One frame of a recording, not read yet. load throws std::runtime_error when the frame cannot be
// read; what() says why.
struct RecordingEntry {
  std::string name;
  int64_t utime = 0;  // [us]
  std::function<FrameContent()> load;
};

}  // namespace declutter
