#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "modules/runtime/event_log.h"

namespace declutter::log_tool {

// Calls handle for every whole event of a log, in its order; what is damaged is skipped. Returns
// what is wrong, each with its place; empty for a whole log. Throws std::runtime_error when the
// file cannot be read.
std::vector<std::string> ForEachEvent(const std::string& path,
                                      const std::function<void(const runtime::LogEvent&)>& handle);

// What a channel of a log holds.
struct ChannelSummary {
  std::string type;  // "object_list_t"; "?" for one of another version or another project
  int64_t num_messages = 0;
  int64_t num_bytes = 0;
  int64_t num_damaged = 0;  // of our types, those that cannot be decoded
  int64_t first_us = 0;     // when it was recorded
  int64_t last_us = 0;
  int64_t max_gap_us = 0;
};

// What a log holds.
struct LogSummary {
  std::map<std::string, ChannelSummary> channels;
  int64_t first_us = 0;
  int64_t last_us = 0;
  int64_t num_backward = 0;  // events that are earlier than the one before
  std::string versions;      // of what made it; empty: it does not say
  std::string graph;
  std::vector<std::string> damages;  // and where
};

LogSummary Summarise(const std::string& path);

// For people.
std::string Text(const LogSummary& summary);

}  // namespace declutter::log_tool
