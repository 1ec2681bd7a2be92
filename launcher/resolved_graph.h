#pragma once

#include <optional>
#include <string>
#include <vector>

#include "launcher/graph.pb.h"
#include "launcher/wiring.h"

namespace declutter::launcher {

// A module of a graph that was checked, ready to start.
struct ResolvedModule {
  Module module;            // program an absolute path
  std::string text;         // its block of a graph file
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

  // The whole as a graph file.
  std::string Text() const {
    std::string text = lossless ? "lossless: true\n" : "lossless: false\n";
    if (logger) text += "logger {\n" + logger->DebugString() + "}\n";
    for (const ResolvedModule& module : modules) text += module.text;
    return text;
  }

  // A line for each program: its path and version.
  std::string Versions() const {
    std::string text;
    for (const ResolvedModule& resolved : modules) {
      text += resolved.module.program() + " " + resolved.version + "\n";
    }
    return text;
  }
};

}  // namespace declutter::launcher
