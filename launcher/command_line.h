#pragma once

#include <optional>
#include <string>
#include <vector>

#include "launcher/excerpt.h"
#include "modules/runtime/config_error.h"

namespace declutter::launcher {

struct CommandLine {
  enum class Verb { kHelp, kCheck, kRun, kStatus, kStart, kStop, kRestart, kSwap, kLogs, kDoctor };

  Verb verb = Verb::kHelp;
  std::string word;                      // the verb as written
  std::string graph;                     // file
  std::string module;                    // of the running graph
  std::string program;                   // to swap in
  std::vector<std::string> assignments;  // of --set, in order
  std::string only;                      // modules and groups; empty: all
  std::string without;                   // modules and groups; empty: none
  std::string record;                    // log to write; empty: none
  std::string replay;                    // log to read in place of the sources; empty: none
  std::string from;                      // first module of a replay; empty: not given
  Excerpt part;                          // of the log of a replay
  std::optional<double> speed;           // of a replay; nothing: without loss
  bool loops = false;                    // a replay
  std::string url;                       // empty: not given
  std::string logs;                      // folder; empty: not given
  std::string run_folder;                // of the running graph; empty: not given
  bool draws = false;                    // the graph for Graphviz
  bool is_isolated = false;
  bool follows = false;  // prints what is new until a signal comes
};

// arguments: without the program's name. Throws runtime::ConfigError.
CommandLine ParseCommandLine(const std::vector<std::string>& arguments);

std::string HelpText();

}  // namespace declutter::launcher
