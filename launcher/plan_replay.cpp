#include "launcher/plan_replay.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "lcmtypes/channels.h"
#include "modules/runtime/config_error.h"
#include "modules/runtime/suggestion.h"

namespace declutter::launcher {
namespace {

std::vector<WiredModule> Wiring(const ResolvedGraph& graph) {
  std::vector<WiredModule> wiring;
  for (const ResolvedModule& resolved : graph.modules) wiring.push_back(resolved.wiring);
  return wiring;
}

size_t FindModule(const std::vector<WiredModule>& wiring, const std::string& name) {
  std::vector<std::string> names;
  for (size_t i = 0; i < wiring.size(); ++i) {
    if (wiring[i].name == name) return i;
    names.push_back(wiring[i].name);
  }
  throw runtime::ConfigError("--from " + name + ": no such module" +
                             runtime::Suggestion(name, names));
}

void AddWithDownstream(const std::vector<WiredModule>& wiring, size_t index,
                       std::set<size_t>* kept) {
  if (!kept->insert(index).second) return;
  for (const size_t next : Downstream(wiring, index)) AddWithDownstream(wiring, next, kept);
}

std::set<size_t> Select(const std::vector<WiredModule>& wiring, const std::string& from) {
  std::set<size_t> kept;
  if (!from.empty()) {
    AddWithDownstream(wiring, FindModule(wiring, from), &kept);
    return kept;
  }
  for (size_t i = 0; i < wiring.size(); ++i) {
    if (!IsSource(wiring[i])) kept.insert(i);
  }
  return kept;
}

// What is needed from the log for a message on channel: what its publisher consumes, and what is
// needed for that. Of a module that does with less, too; nothing tells which those are.
void AddNeeded(const std::string& channel, const std::vector<WiredModule>& wiring,
               const std::map<std::string, std::string>& fed, std::set<std::string>* visited,
               std::set<std::string>* needed) {
  if (!visited->insert(channel).second) return;
  if (fed.count(channel) > 0) needed->insert(channel);
  const auto is_channel = [&](const Port& port) { return port.channel == channel; };
  for (const WiredModule& module : wiring) {
    if (std::none_of(module.outputs.begin(), module.outputs.end(), is_channel)) continue;
    for (const Port& input : module.inputs) {
      AddNeeded(input.channel, wiring, fed, visited, needed);
    }
  }
}

std::set<std::string> Needed(const std::set<std::string>& awaited,
                             const std::vector<WiredModule>& wiring,
                             const std::map<std::string, std::string>& fed) {
  std::set<std::string> visited, needed;
  for (const std::string& channel : awaited) AddNeeded(channel, wiring, fed, &visited, &needed);
  return needed;
}

}  // namespace

ReplayPlan PlanReplay(const CommandLine& line, ResolvedGraph* graph) {
  std::vector<ResolvedModule> kept;
  for (const size_t index : Select(Wiring(*graph), line.from)) {
    kept.push_back(std::move(graph->modules[index]));
  }
  graph->modules = std::move(kept);
  graph->lossless = !line.speed;
  graph->logger.reset();

  ReplayPlan plan{line.replay, {}, {}, {}, line.part, line.speed, line.loops};
  std::set<std::string> objects;
  for (const ResolvedModule& resolved : graph->modules) {
    for (const Port& input : resolved.wiring.inputs) plan.fed[input.channel] = input.type;
    for (const Port& output : resolved.wiring.outputs) {
      plan.awaited.insert(output.channel);
      if (output.type == object_list_t::getTypeName()) objects.insert(output.channel);
    }
  }
  plan.fed.erase(kModuleStatus.name);
  plan.awaited.erase(kModuleStatus.name);
  for (const std::string& channel : plan.awaited) plan.fed.erase(channel);
  // Objects are a frame's last result: they tell of all others.
  if (!objects.empty()) plan.awaited = objects;
  // Live, a module skips frames: then the log has none of their results.
  if (!line.speed) plan.needed = Needed(plan.awaited, Wiring(*graph), plan.fed);
  // Who publishes nothing tells in its status, if only once a second.
  if (plan.awaited.empty()) plan.awaited.insert(kModuleStatus.name);
  if (plan.fed.empty()) throw runtime::ConfigError("--replay: nothing is needed from the log");
  return plan;
}

}  // namespace declutter::launcher
