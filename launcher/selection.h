#pragma once

#include <string>

#include "launcher/resolved_graph.h"

namespace declutter::launcher {

// Leaves in graph only the modules of `only` without those of `without`: names of modules or of
// their groups, with commas between; empty: all, or none. What they consume may come from elsewhere
// in the same network. Throws runtime::ConfigError for an unknown name, or when nothing is left.
void Select(const std::string& only, const std::string& without, ResolvedGraph* graph);

}  // namespace declutter::launcher
