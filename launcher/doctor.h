#pragma once

#include <string>

namespace declutter::launcher {

// Looks at what a run needs from this machine and prints a line for each, with what mends it. logs:
// the folder of the runs' folders. Returns 1 when something is in the way of every run, else 0.
int Examine(const std::string& logs);

}  // namespace declutter::launcher
