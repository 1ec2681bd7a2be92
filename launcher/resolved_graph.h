#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "launcher/graph.pb.h"
#include "launcher/wiring.h"

namespace declutter::launcher {

// A module of a graph that was checked, ready to start.
struct ResolvedModule {
  Module module;            // program an absolute path
  std::string version;      // of the program
  std::string config_text;  // its parameters as protobuf text, all layers merged
  WiredModule wiring;
  std::vector<Fault> missing;  // parameters that a run needs and nothing sets
};

// A graph that was checked.
struct ResolvedGraph {
  bool lossless = false;
  std::vector<ResolvedModule> modules;
  std::optional<Logger> logger;
  std::set<std::string> external;  // channels that come from outside

  // The whole as a graph file.
  std::string Text() const;

  // A line for each program: its path and version.
  std::string Versions() const;
};

}  // namespace declutter::launcher
