#pragma once

#include <cstdint>
#include <fstream>
#include <optional>
#include <string>

#include "modules/runtime/part.h"

// Log files as lcm-logger writes them.
namespace declutter::runtime {

struct LogEvent {
  std::int64_t utime;  // [us] when it was recorded
  std::string channel;
  Bytes message;
};

class EventLogReader {
 public:
  // Throws std::runtime_error when the file cannot be read or is empty.
  explicit EventLogReader(const std::string& path);

  // nullopt after the last event. Throws std::runtime_error where the file is cut off or is not a
  // log; every complete event before that place was returned.
  std::optional<LogEvent> Next();

  // After Next() has thrown: goes to the next place where an event may begin, also within the event
  // returned last, as its length may be what is damaged. False when there is none.
  bool SkipDamage();

  std::uint64_t offset() const { return offset_; }  // of the next event [byte]
  std::uint64_t size() const { return size_; }      // of the file [byte]

 private:
  std::runtime_error Broken(const std::string& what) const;

  std::string path_;
  std::ifstream file_;
  std::uint64_t size_ = 0;    // of the file [byte]
  std::uint64_t offset_ = 0;  // of the next event [byte]
  std::uint64_t last_ = 0;    // of the event returned last [byte]
  std::uint64_t floor_ = 0;   // up to here no event is searched for again [byte]
  std::int64_t num_events_ = 0;
};

class EventLogWriter {
 public:
  // Makes a new file. Throws ConfigError when there is one already, std::runtime_error when it
  // cannot be made.
  explicit EventLogWriter(const std::string& path);
  ~EventLogWriter();
  EventLogWriter(const EventLogWriter&) = delete;
  EventLogWriter& operator=(const EventLogWriter&) = delete;

  // Throws std::runtime_error when the disk does not take it.
  void Write(const LogEvent& event);

 private:
  std::string path_;
  int fd_;
  std::int64_t num_events_ = 0;
};

}  // namespace declutter::runtime
