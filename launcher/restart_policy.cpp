#include "launcher/restart_policy.h"

#include <algorithm>
#include <cmath>

namespace declutter::launcher {

std::optional<double> Backoff::Next(double ran_s) {
  constexpr double kWellAfter = 10.0;  // delays
  if (num_in_a_row_ > 0 && ran_s >= kWellAfter * delay_s_) Reset();
  if (num_in_a_row_ == rule_.max_in_a_row) return std::nullopt;
  delay_s_ = std::min(std::ldexp(rule_.first_delay_s, num_in_a_row_), rule_.max_delay_s);
  ++num_in_a_row_;
  return delay_s_;
}

}  // namespace declutter::launcher
