#pragma once

#include <string>

#include "launcher/resolved_graph.h"

namespace declutter::launcher {

// Leaves in graph only the modules of `only` without those of `without`: names of modules or of
// their groups, with commas between; empty: all, or none. What they consume may come from elsewhere
// in the same network. Throws runtime::ConfigError for an unknown name, or when nothing is left.
void Select(const std::string& only, const std::string& without, ResolvedGraph* graph);

// Lets what is left of a graph stand for itself: what it consumes and nothing in it publishes comes
// from outside, and nothing waits for a module that is not there.
void MakeWhole(ResolvedGraph* graph);

}  // namespace declutter::launcher
