#pragma once

#include <optional>
#include <string>

#include "launcher/log_feeder.h"
#include "launcher/resolved_graph.h"
#include "launcher/supervisor.h"

namespace declutter::launcher {

struct RunOptions {
  std::string url;     // of the network; empty: one that nobody else uses
  std::string record;  // log to write; empty: none
  std::string logs;    // folder of the runs' folders
  std::optional<ReplayPlan> replay = {};
  bool is_isolated = false;  // in a network of its own
};

// Runs a graph to its end; returns the exit code. Throws std::runtime_error when there is no
// network, no folder for logs or no recorder.
int RunGraph(const ResolvedGraph& graph, const RunOptions& options);

}  // namespace declutter::launcher
