#pragma once

#include <string>

#include "launcher/command_line.h"

namespace declutter::launcher {

// The verbs that concern a graph which runs. Each returns the exit code; throws std::runtime_error
// when no graph runs in line.run_folder, the one started last where that is empty.

// A line for each process.
int ShowStatus(const CommandLine& line);

// What a module has printed, whether the graph still runs or not.
int ShowLog(const CommandLine& line);

// start, stop, restart.
int Order(const CommandLine& line);

// Checks the new program and its parameters in the graph as it runs before it takes over.
int Swap(const CommandLine& line);

}  // namespace declutter::launcher
