#pragma once

#include <string>

#include "launcher/rotating_log.h"

namespace declutter::launcher {

// What the launcher itself says, a line at a time: on stderr, and with the time in a log beside
// those of its processes.
class LauncherLog {
 public:
  // Throws std::runtime_error when the file cannot be opened.
  explicit LauncherLog(const std::string& path);

  void Say(const std::string& text);

 private:
  RotatingLog log_;
};

}  // namespace declutter::launcher
