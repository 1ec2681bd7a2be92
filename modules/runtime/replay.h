#pragma once

#include <string>

#include "modules/runtime/shell.h"

namespace declutter::runtime {

// Runs the shell's module over the log at in, without a network, a clock or a skipped frame, and
// writes what it publishes to a new log at out (empty: nowhere), each message with the time of the
// event that caused it. Of a frame that the log does not hold all of, because a module skipped it,
// nothing is used. Throws ConfigError for a module or a file that cannot
// be replayed, std::runtime_error for a log without its frames.
void Replay(const std::string& in, const std::string& out, Shell* shell);

}  // namespace declutter::runtime
