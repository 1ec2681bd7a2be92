#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "modules/runtime/event_log.h"

namespace declutter::log_tool {

// Calls handle for every whole event of a log, in its order, with its time as TimedLog tells it;
// what is damaged is skipped. Returns what is wrong, each with its place; empty for a whole log.
// Throws std::runtime_error when the file cannot be read.
std::vector<std::string> ForEachEvent(
    const std::string& path,
    const std::function<void(const runtime::LogEvent&, double at_s)>& handle);

// As much of it as handle returns true.
std::vector<std::string> ForEachEventWhile(
    const std::string& path,
    const std::function<bool(const runtime::LogEvent&, double at_s)>& handle);

// What a channel of a log holds.
struct ChannelSummary {
  std::string type;  // "object_list_t"; "?" for one of another version or another project
  int64_t num_messages = 0;
  int64_t num_bytes = 0;
  int64_t num_damaged = 0;  // of our types, those that cannot be decoded
  double first_s = 0.0;     // when it was recorded, from the log's first event
  double last_s = 0.0;
  double max_gap_s = 0.0;
  uint64_t hash = 0;  // of all messages in their order
};

// What a log holds.
struct LogSummary {
  std::map<std::string, ChannelSummary> channels;
  double span_s = 0.0;
  int64_t num_backward = 0;  // events that are earlier than the one before
  std::string versions;      // of what made it; empty: it does not say
  std::string graph;
  std::vector<std::string> damages;  // and where
};

LogSummary Summarise(const std::string& path);

// For people.
std::string Text(const LogSummary& summary);

}  // namespace declutter::log_tool
