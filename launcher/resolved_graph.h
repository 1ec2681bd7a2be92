#pragma once

#include <memory>
#include <string>
#include <vector>

#include "launcher/graph.pb.h"
#include "launcher/wiring.h"

namespace declutter::launcher {

// A module of a graph that was checked, ready to start.
struct ResolvedModule {
  Module module;            // program an absolute path
  std::string config_text;  // its parameters as protobuf text, all layers merged
  WiredModule wiring;
  std::vector<Fault> missing;  // parameters that a run needs and nothing sets
};

// A graph that was checked.
struct ResolvedGraph {
  bool lossless = false;
  std::vector<ResolvedModule> modules;
  std::string text;  // the whole as a graph file
};

}  // namespace declutter::launcher
