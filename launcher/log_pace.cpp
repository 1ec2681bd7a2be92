#include "launcher/log_pace.h"

#include <algorithm>
#include <limits>

namespace declutter::launcher {

double LogPace::Wait(double at_s, double now_s) const {
  if (!stands_still_) return std::max(0.0, start_s_ + at_s / speed_ - now_s);
  return at_s <= position_s_ ? 0.0 : std::numeric_limits<double>::infinity();
}

void LogPace::Toggle(double now_s) {
  if (stands_still_) {
    start_s_ = now_s - position_s_ / speed_;
  } else {
    position_s_ = (now_s - start_s_) * speed_;
  }
  stands_still_ = !stands_still_;
}

void LogPace::StepTo(double at_s) {
  if (stands_still_) position_s_ = std::max(position_s_, at_s);
}

}  // namespace declutter::launcher
