#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "launcher/excerpt.h"
#include "launcher/timed_log.h"
#include "launcher/wire.h"

namespace declutter::launcher {

// The messages of one frame in a log.
struct LoggedFrame {
  int64_t utime = 0;  // [us] of the sensor
  double at_s = 0.0;  // when the last of them was recorded, from the log's first event
  std::vector<Message> messages;
};

// Reads a log frame by frame, in the order of their first messages. Holds only frames of which a
// message is still to come, however long the log is.
class LoggedFrames {
 public:
  // types: of the messages, by the channels to read. needed: channels without which a frame is left
  // out. A frame belongs to a part of the log when its first message does. Reads through the log
  // once. Throws std::runtime_error when it cannot be read, when that part holds no frame, or when
  // a channel holds nothing but another type, or version of its type.
  LoggedFrames(const std::string& path, const std::map<std::string, std::string>& types,
               const std::set<std::string>& needed, const Excerpt& part);

  // A message sent again is there once. Nothing after the last.
  std::optional<LoggedFrame> Next();

  // What frames were left out and why, for people; empty when none was.
  const std::string& left_out() const { return left_out_; }

  // Where and why the log ends early; empty for a whole one.
  const std::string& damage() const { return damage_; }

 private:
  // Of a frame.
  struct ToCome {
    int num_messages = 0;           // not read yet
    std::set<std::string> lacking;  // needed channels on which there is none
  };

  std::optional<TimedEvent> NextEvent(TimedLog* log);
  void CountMessages(const std::set<std::string>& needed, const Excerpt& part);
  void LeaveOutIncomplete();

  std::string path_;
  std::map<std::string, std::string> types_;
  std::string damage_;
  std::string left_out_;
  TimedLog log_;
  std::map<int64_t, ToCome> to_come_;  // by utime
  std::deque<LoggedFrame> begun_;
};

}  // namespace declutter::launcher
