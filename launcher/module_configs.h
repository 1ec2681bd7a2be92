#pragma once

#include <google/protobuf/message.h>

#include <memory>
#include <string>
#include <vector>

#include "launcher/graph_files.h"
#include "launcher/program_catalog.h"

namespace declutter::launcher {

using Config = std::unique_ptr<google::protobuf::Message>;

// The parameters of a module, from all layers of the graph. type: as its program declares it.
// skips_other_types: what is there for another program is left out, else it is a fault.
Config ReadConfig(const MergedModule& module, const google::protobuf::Descriptor* type,
                  bool skips_other_types, ProgramCatalog* catalog, std::vector<Fault>* faults);

// Applies `module.field=value` to the config of that module. configs: as modules.
void Assign(const std::string& assignment, const std::vector<MergedModule>& modules,
            std::vector<Config>* configs, std::vector<Fault>* faults);

// The parameters that a run needs and nothing sets.
std::vector<Fault> FindMissing(const MergedModule& module, const google::protobuf::Message& config);

}  // namespace declutter::launcher
