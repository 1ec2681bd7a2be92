#pragma once

#include <array>
#include <cstdint>

namespace declutter {

// Lets the time of a recording go on where its player begins again after the last frame. Of depth
// and colour, either may begin again first.
class LoopClock {
 public:
  enum Stream { kDepth, kColor };
  struct Time {
    int64_t loop = 0;  // from 0 on
    int64_t device_us = 0;
  };

  // period_us: from the last frame of a loop to the first of the next.
  explicit LoopClock(int64_t period_us) : period_us_(period_us) {}

  // Of the next frame of a stream. index: its number in the recording; device_us: its time there.
  Time At(Stream stream, int64_t index, int64_t device_us);

 private:
  struct Last {
    bool exists = false;
    int64_t index = 0;
    int64_t device_us = 0;  // in the recording
    int64_t loop = 0;
  };

  const int64_t period_us_;
  std::array<Last, 2> last_;
  int64_t duration_us_ = 0;  // of a loop; 0: none has ended
};

}  // namespace declutter
