#pragma once

#include <string>

#include "launcher/excerpt.h"

namespace declutter::log_tool {

struct TopOptions {
  std::string channel;             // whose latest message is shown; empty: the first one
  double seconds = 0.0;            // then it ends; 0: when the log ends, or not at all
  launcher::Excerpt excerpt = {};  // of a log
  double speed = 1.0;              // at which a log is played
};

// Shows what goes over the network of url until it is ended: a screen, renewed every second, where
// j and k choose the channel whose latest message is shown and q ends it; where stdout is no
// terminal, one block of text at the end. Returns the exit code. Throws std::runtime_error when the
// network cannot be joined.
int WatchNetwork(const std::string& url, const TopOptions& options);

// As much of a log that is played. 1 when it is damaged; throws as PlayTo does.
int WatchLog(const std::string& log, const TopOptions& options);

}  // namespace declutter::log_tool
