#pragma once

#include <vector>

#include "launcher/run.h"

namespace declutter::launcher {

// No names of modules: these have no dash.
inline constexpr const char* kLogger = "lcm-logger";
inline constexpr const char* kFeeder = "log-feeder";

// The processes of a run: the modules, a recorder downstream of all of them, a log in place of
// sources.
std::vector<Node> PlanNodes(const ResolvedGraph& graph, const RunOptions& options);

}  // namespace declutter::launcher
