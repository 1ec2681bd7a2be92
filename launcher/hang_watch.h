#pragma once

#include <limits>

namespace declutter::launcher {

// Notices a process that lives but gets nowhere: a frame is begun or waits and none was finished
// for a while, or it has fallen silent. Times are of any clock that does not go back.
class HangWatch {
 public:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  explicit HangWatch(double limit_s) : limit_s_(limit_s) {}

  void Start(double now_s);

  // A sign of life. num_done: frames finished so far; is_busy: one is begun or waits.
  void Beat(long num_done, bool is_busy, double now_s);

  bool is_stuck(double now_s) const { return is_busy_ && now_s - progress_s_ > limit_s_; }
  bool is_silent(double now_s) const { return now_s - beat_s_ > silence_limit_s(); }
  double limit_s() const { return limit_s_; }
  // Signs of life come once a second, on a busy machine later.
  double silence_limit_s() const { return limit_s_ + 5.0; }

 private:
  double limit_s_;
  long num_done_ = 0;
  bool is_busy_ = false;
  double progress_s_ = 0.0;  // when it was last idle or last finished a frame
  double beat_s_ = 0.0;
};

}  // namespace declutter::launcher
