#pragma once

#include <cstdint>
#include <exception>
#include <optional>
#include <string>

#include "modules/runtime/event_log.h"

namespace declutter::launcher {

// An event of a log, and how long after the first one it was recorded.
struct TimedEvent {
  runtime::LogEvent event;
  double at_s = 0.0;  // never less than that of the event before
};

// Reads a log in its time, also where its clock is wrong: a single event with a time of its own,
// as when a byte is damaged, counts as recorded with its neighbours, and where the clock was set
// back, time goes on from there.
class TimedLog {
 public:
  // Throws as runtime::EventLogReader does.
  explicit TimedLog(const std::string& path) : reader_(path) {}

  // As runtime::EventLogReader.
  std::optional<TimedEvent> Next();
  bool SkipDamage();

 private:
  void Advance();
  int64_t GapBefore(const runtime::LogEvent& event);

  runtime::EventLogReader reader_;
  std::optional<runtime::LogEvent> current_;
  std::optional<runtime::LogEvent> next_;
  std::exception_ptr fault_;             // met while looking ahead
  std::optional<int64_t> last_us_;       // of the event given last, as far as it is believed
  int64_t longest_gap_us_ = 10'000'000;  // between events so far, or 10 s
  int64_t at_us_ = 0;
  bool is_begun_ = false;          // next_ has been read
  bool is_in_the_middle_ = false;  // two events have been given
};

}  // namespace declutter::launcher
