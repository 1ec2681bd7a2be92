#include "launcher/selection.h"

#include <algorithm>
#include <set>
#include <sstream>
#include <vector>

#include "modules/runtime/config_error.h"
#include "modules/runtime/suggestion.h"

namespace declutter::launcher {
namespace {

// The modules that a list of names means.
std::set<std::string> ModulesOf(const std::string& flag, const std::string& list,
                                const ResolvedGraph& graph) {
  std::set<std::string> found;
  std::vector<std::string> known;
  for (const ResolvedModule& resolved : graph.modules) {
    known.push_back(resolved.module.name());
    known.insert(known.end(), resolved.module.group().begin(), resolved.module.group().end());
  }
  std::istringstream names(list);
  for (std::string name; std::getline(names, name, ',');) {
    if (std::count(known.begin(), known.end(), name) == 0) {
      throw runtime::ConfigError(flag + " " + list + ": no module or group named '" + name + "'" +
                                 runtime::Suggestion(name, known));
    }
    for (const ResolvedModule& resolved : graph.modules) {
      const auto& groups = resolved.module.group();
      const bool is_meant =
          resolved.module.name() == name || std::count(groups.begin(), groups.end(), name) != 0;
      if (is_meant) found.insert(resolved.module.name());
    }
  }
  return found;
}

}  // namespace

void Select(const std::string& only, const std::string& without, ResolvedGraph* graph) {
  const std::set<std::string> wanted = ModulesOf("--only", only, *graph);
  const std::set<std::string> unwanted = ModulesOf("--without", without, *graph);
  const auto is_out = [&](const ResolvedModule& resolved) {
    const std::string& name = resolved.module.name();
    return (!only.empty() && wanted.count(name) == 0) || unwanted.count(name) != 0;
  };
  auto& modules = graph->modules;
  modules.erase(std::remove_if(modules.begin(), modules.end(), is_out), modules.end());
  if (modules.empty()) throw runtime::ConfigError("--only and --without leave no module");
}

void MakeWhole(ResolvedGraph* graph) {
  std::vector<WiredModule> wiring;
  std::set<std::string> names;
  for (const ResolvedModule& resolved : graph->modules) {
    wiring.push_back(resolved.wiring);
    names.insert(resolved.module.name());
  }
  graph->external = Unpublished(wiring);
  for (ResolvedModule& resolved : graph->modules) {
    const std::vector<std::string> before = resolved.wiring.after;
    resolved.module.clear_after();
    for (const std::string& name : before) {
      if (names.count(name) != 0) resolved.module.add_after(name);
    }
  }
}

}  // namespace declutter::launcher
