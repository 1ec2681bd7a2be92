#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "modules/kinect_source/sensor.h"

namespace declutter {

// Gives each depth image the colour image that was taken at the same time, to half a period: the
// streams of a sensor are not read in step.
class ColorMatch {
 public:
  explicit ColorMatch(int64_t period_us) : tolerance_us_(period_us / 2) {}

  void AddColor(int64_t device_us, ColorImage image);

  // depth without colour; takes the place of one that still waits, which is returned.
  std::optional<SensorFrame> AddDepth(SensorFrame depth);

  // The depth image that waits, when its colour is there or can no longer come.
  std::optional<SensorFrame> Take();
  // The depth image that waits, with or without colour.
  std::optional<SensorFrame> TakeAnyhow();

  bool is_waiting() const { return waiting_.has_value(); }

 private:
  struct Color {
    int64_t device_us;
    ColorImage image;
  };

  bool FindColor();

  const int64_t tolerance_us_;
  std::optional<SensorFrame> waiting_;
  std::deque<Color> colors_;  // oldest first
};

}  // namespace declutter
