#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "launcher/wire.h"

namespace declutter::log_tool {

// What goes over channels. Times are those of one clock and do not decrease.
class ChannelMonitor {
 public:
  void Add(const launcher::Message& message, double at_s);

  // A line for each channel: type, number of messages, rate and bandwidth in the last two seconds,
  // size and age of the latest one; then the fields of the latest one on the chosen channel.
  std::vector<std::string> Lines(double now_s) const;

  // The channel next to the chosen one, step lines down. Until then it is the first that carries
  // one of our types.
  void Choose(int step);
  void Choose(const std::string& channel) { chosen_ = channel; }

 private:
  struct Traffic {
    int64_t num_messages = 0;
    std::deque<std::pair<double, size_t>> recent;  // time [s] and size [byte]
    launcher::Message latest;
    double latest_s = 0.0;
  };

  std::string Line(const std::string& channel, const Traffic& traffic, double now_s) const;

  std::map<std::string, Traffic> channels_;
  std::string chosen_;
};

}  // namespace declutter::log_tool
