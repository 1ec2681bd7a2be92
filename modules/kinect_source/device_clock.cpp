#include "modules/kinect_source/device_clock.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace declutter {
namespace {

// A frame does not take longer on its way, nor do clocks of sensors drift apart by as much.
constexpr int64_t kMaxDeviation_us = 500'000;
// Part of a later arrival that is taken for drift: 100 us in a second of frames 3 ms late.
constexpr double kDriftGain = 0.001;

}  // namespace

void DeviceClock::Restart() {
  const int64_t last_utime = last_utime_;
  *this = {};
  last_utime_ = last_utime;
}

bool DeviceClock::HasJumped(int64_t device_us, int64_t arrival_us) const {
  if (device_us <= last_device_us_) return true;
  return std::abs(arrival_us - (device_us + *offset_us_)) > kMaxDeviation_us;
}

int64_t DeviceClock::ToUtime(int64_t device_us, int64_t arrival_us) {
  const bool is_known = offset_us_.has_value();
  const bool has_jumped = is_known && HasJumped(device_us, arrival_us);
  if (has_jumped) ++num_jumps_;
  if (!is_known || has_jumped) {
    offset_us_ = arrival_us - device_us;
  } else {
    const auto interval_error =
        static_cast<double>((arrival_us - last_arrival_us_) - (device_us - last_device_us_));
    sum_of_squares_us2_ += interval_error * interval_error;
    ++num_intervals_;
    const int64_t late_us = arrival_us - (device_us + *offset_us_);
    *offset_us_ += late_us < 0 ? late_us : std::llround(kDriftGain * static_cast<double>(late_us));
  }
  last_device_us_ = device_us;
  last_arrival_us_ = arrival_us;
  last_utime_ = std::max(last_utime_ + 1, device_us + *offset_us_);
  return last_utime_;
}

double DeviceClock::jitter_us() const {
  return num_intervals_ == 0 ? 0
                             : std::sqrt(sum_of_squares_us2_ / static_cast<double>(num_intervals_));
}

}  // namespace declutter
