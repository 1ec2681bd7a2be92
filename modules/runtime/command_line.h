#pragma once

#include <map>
#include <string>
#include <vector>

namespace declutter::runtime {

// The command line that all modules share.
struct CommandLine {
  enum class Action { kRun, kHelp, kPrintConfig, kDescribe };

  Action action = Action::kRun;
  std::string program;                       // name of the executable
  std::string name;                          // in the graph; the program's unless given
  std::string config_file;                   // empty: none
  std::vector<std::string> assignments;      // of --set, in order
  std::map<std::string, std::string> remap;  // channel of the module -> channel on the wire
  bool lossless = false;
  bool hold = false;
  std::string replay;  // log to read instead of the network; empty: none
  std::string record;  // log to write the replay's results to; empty: none
};

// Throws ConfigError.
CommandLine ParseCommandLine(int argc, const char* const* argv);

// The options and what they mean, a line each.
std::string OptionsHelp();

}  // namespace declutter::runtime
