#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace declutter::log_tool {

// Which part of a log, and how fast.
struct Excerpt {
  double start_s = 0.0;               // from the log's first event
  double end_s = 1e18;                //
  std::vector<std::string> channels;  // empty: all

  // first_us: of the log.
  bool Holds(const std::string& channel, int64_t utime, int64_t first_us) const;
};

// Publishes a part of a log in the time in which it was recorded, divided by speed; again and again
// when it loops. Where stdin is a terminal, the space bar stops it and lets it go on, and n gives
// the next message while it is stopped. Returns the exit code: 1 when the log is damaged. Throws
// std::runtime_error when log or network cannot be opened.
int Play(const std::string& log, const Excerpt& excerpt, double speed, bool loops,
         const std::string& url);

}  // namespace declutter::log_tool
