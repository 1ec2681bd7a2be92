#pragma once

#include <limits>
#include <set>
#include <string>

namespace declutter::launcher {

// Which part of a log.
struct Excerpt {
  double start_s = 0.0;  // from the log's first event
  double end_s = std::numeric_limits<double>::infinity();
  std::set<std::string> channels;  // empty: all

  bool Holds(const std::string& channel, double at_s) const {
    return at_s >= start_s && at_s <= end_s && (channels.empty() || channels.count(channel) > 0);
  }
};

inline constexpr double kMinSpeed = 0.001;  // at which a log is played

// A number that a user wrote, from min. Throws runtime::ConfigError.
double ParseNumber(const std::string& text, double min);

}  // namespace declutter::launcher
