#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "launcher/program_catalog.h"
#include "launcher/resolved_graph.h"
#include "launcher/wiring.h"

namespace declutter::launcher {

// Reads and checks a graph file: syntax, names, programs, parameters of programs that are not
// linked here, channels. Each program is asked with --describe.
//
// swapped: modules that get another program, an absolute path; parameters of another type than that
// program's are left out. assignments: `module.field=value`, on top of what the file says. Nothing
// when there is a fault; all that were found are added to faults. catalog: what is known of
// programs already.
std::optional<ResolvedGraph> LoadGraph(const std::string& path,
                                       const std::vector<std::string>& assignments,
                                       const std::map<std::string, std::string>& swapped,
                                       ProgramCatalog* catalog, std::vector<Fault>* faults);

}  // namespace declutter::launcher
