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

 private:
  std::runtime_error Broken(const std::string& what) const;

  std::string path_;
  std::ifstream file_;
  std::uint64_t size_ = 0;    // of the file [byte]
  std::uint64_t offset_ = 0;  // of the next event [byte]
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
