#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "launcher/wire.h"
#include "modules/runtime/event_log.h"

namespace declutter::launcher {

// The messages of one frame in a log.
struct LoggedFrame {
  int64_t utime = 0;  // [us] of the sensor
  std::vector<Message> messages;
};

// Reads a log frame by frame, in the order of their first messages. Holds only frames of which a
// message is still to come, however long the log is.
class LoggedFrames {
 public:
  // channels: those to read. Reads through the log once. Throws std::runtime_error when it cannot
  // be read or holds none of these channels.
  LoggedFrames(const std::string& path, const std::set<std::string>& channels);

  // A message sent again is there once. Nothing after the last.
  std::optional<LoggedFrame> Next();

  // Where and why the log ends early; empty for a whole one.
  const std::string& damage() const { return damage_; }

 private:
  std::optional<runtime::LogEvent> NextEvent(runtime::EventLogReader* reader);

  std::set<std::string> channels_;
  std::string damage_;
  runtime::EventLogReader reader_;
  std::map<int64_t, int> num_to_come_;  // messages of each frame not read yet
  std::deque<LoggedFrame> begun_;
};

}  // namespace declutter::launcher
