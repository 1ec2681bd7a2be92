#include "launcher/timed_log.h"

#include <algorithm>
#include <utility>

namespace declutter::launcher {
namespace {

int64_t Median(int64_t a, int64_t b, int64_t c) {
  return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

// From a to b, 0 when b is before a; a damaged time may be any number.
int64_t Gap(int64_t a_us, int64_t b_us) {
  constexpr uint64_t kYear_us = 31'557'600'000'000;
  if (b_us <= a_us) return 0;
  return static_cast<int64_t>(
      std::min(kYear_us, static_cast<uint64_t>(b_us) - static_cast<uint64_t>(a_us)));
}

}  // namespace

std::optional<TimedEvent> TimedLog::Next() {
  if (!is_begun_) Advance();
  is_begun_ = true;
  Advance();
  if (!current_) {
    if (fault_) std::rethrow_exception(std::exchange(fault_, nullptr));
    return std::nullopt;
  }
  at_us_ += last_us_ ? GapBefore(*current_) : 0;
  if (!last_us_) last_us_ = current_->utime;
  return TimedEvent{std::move(*std::exchange(current_, std::nullopt)),
                    static_cast<double>(at_us_) / 1e6};
}

bool TimedLog::SkipDamage() {
  is_begun_ = false;
  return reader_.SkipDamage();
}

void TimedLog::Advance() {
  current_ = std::exchange(next_, std::nullopt);
  if (fault_) return;
  try {
    next_ = reader_.Next();
  } catch (const std::runtime_error&) {
    fault_ = std::current_exception();
  }
}

int64_t TimedLog::GapBefore(const runtime::LogEvent& event) {
  const int64_t time_us = next_ ? Median(*last_us_, event.utime, next_->utime) : event.utime;
  int64_t gap_us = Gap(*last_us_, time_us);
  // Of the first event and of the last one, also before a damage, no two neighbours tell whether
  // their time is right.
  if (!next_ || !is_in_the_middle_) gap_us = std::min(gap_us, longest_gap_us_);
  last_us_ = next_ ? time_us : *last_us_ + gap_us;
  longest_gap_us_ = std::max(longest_gap_us_, gap_us);
  is_in_the_middle_ = true;
  return gap_us;
}

}  // namespace declutter::launcher
