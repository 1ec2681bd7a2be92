#pragma once

#include <string>
#include <vector>

namespace declutter::launcher {

struct ProgramOutput {
  int code = 0;     // of exit(); 1 when a signal or the time limit ended it
  std::string how;  // for people
  std::string out;  // stdout
  std::string err;  // last line of stderr
};

// Runs command[0], a path, with its arguments to its end. Throws std::runtime_error when no process
// can be made.
ProgramOutput RunProgram(const std::vector<std::string>& command, double limit_s);

}  // namespace declutter::launcher
