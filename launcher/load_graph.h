#pragma once

#include <optional>
#include <string>
#include <vector>

#include "launcher/resolved_graph.h"
#include "launcher/wiring.h"

namespace declutter::launcher {

// Reads and checks a graph file: syntax, names, programs, parameters of programs that are not
// linked here, channels. Each program is asked with --describe.
//
// assignments: `module.field=value`, on top of what the file says. Nothing when there is a fault;
// all that were found are added to faults.
std::optional<ResolvedGraph> LoadGraph(const std::string& path,
                                       const std::vector<std::string>& assignments,
                                       std::vector<Fault>* faults);

}  // namespace declutter::launcher
