#include "modules/kinect_source/loop_clock.h"

#include <algorithm>

namespace declutter {

LoopClock::Time LoopClock::At(Stream stream, int64_t index, int64_t device_us) {
  Last& last = last_[stream];
  const bool begins_again = last.exists && index <= last.index;
  // Frames come in the order of the file: when one stream begins again, the other has ended.
  if (begins_again && duration_us_ == 0) {
    duration_us_ = std::max(last_[kDepth].device_us, last_[kColor].device_us) + period_us_;
  }
  last = {true, index, device_us, last.loop + (begins_again ? 1 : 0)};
  return {last.loop, last.loop * duration_us_ + device_us};
}

}  // namespace declutter
