#pragma once

#include "launcher/command_line.h"
#include "launcher/log_feeder.h"
#include "launcher/resolved_graph.h"

namespace declutter::launcher {

// Leaves in graph only the module of --from and all downstream of it, or all but the sources
// without it; says what they need from the log of --replay, and how it is to be fed. Throws
// runtime::ConfigError for a module that is not in the graph, or when nothing is needed from the
// log.
ReplayPlan PlanReplay(const CommandLine& line, ResolvedGraph* graph);

}  // namespace declutter::launcher
