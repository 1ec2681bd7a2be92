#pragma once

#include <cstdint>
#include <optional>

namespace declutter {

// Maps the timestamps of a sensor's own clock to utime. The sensor's clock is believed from frame
// to frame, and its offset follows the frames that took least time on their way; when it jumps
// against the time of arrival, that counts, until the next jump. Result: rising by 1 us at least.
class DeviceClock {
 public:
  // utime of a frame taken at device_us, arrived at arrival_us; both [us].
  int64_t ToUtime(int64_t device_us, int64_t arrival_us);

  // Forgets the sensor's clock and figures, not the last utime: another device, or the same opened
  // again.
  void Restart();

  int64_t num_jumps() const { return num_jumps_; }
  // Root mean square of how much longer or shorter than taken two frames arrived apart [us].
  double jitter_us() const;

 private:
  bool HasJumped(int64_t device_us, int64_t arrival_us) const;

  std::optional<int64_t> offset_us_;  // utime - device time
  int64_t last_device_us_ = 0;
  int64_t last_arrival_us_ = 0;
  int64_t last_utime_ = 0;
  int64_t num_jumps_ = 0;
  int64_t num_intervals_ = 0;
  double sum_of_squares_us2_ = 0;
};

}  // namespace declutter
