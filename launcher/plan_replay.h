#pragma once

#include <string>

#include "launcher/log_feeder.h"
#include "launcher/resolved_graph.h"

namespace declutter::launcher {

// Leaves in graph only the module named from and all downstream of it, or all but the sources when
// from is empty; says what they need from the log. Throws runtime::ConfigError for a module that is
// not in the graph, or when nothing is needed from the log.
ReplayPlan PlanReplay(const std::string& log, const std::string& from, ResolvedGraph* graph);

}  // namespace declutter::launcher
