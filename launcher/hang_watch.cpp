#include "launcher/hang_watch.h"

namespace declutter::launcher {

void HangWatch::Start(double now_s) {
  num_done_ = 0;
  is_busy_ = false;
  progress_s_ = beat_s_ = now_s;
}

void HangWatch::Beat(long num_done, bool is_busy, double now_s) {
  // The time before the first beat that says busy may have been idle.
  if (!is_busy || !is_busy_ || num_done != num_done_) progress_s_ = now_s;
  is_busy_ = is_busy;
  num_done_ = num_done;
  beat_s_ = now_s;
}

}  // namespace declutter::launcher
