#pragma once

#include <string>

namespace declutter::launcher {

// Writes to stderr what it takes without waiting, the rest is lost: a terminal that is held, or a
// pipe that nobody reads, must not hold a run.
void WriteToConsole(const std::string& text);

}  // namespace declutter::launcher
