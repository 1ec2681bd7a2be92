#include "launcher/wiring.h"

#include <algorithm>
#include <iostream>
#include <map>
#include <optional>

#include "lcmtypes/channels.h"
#include "modules/runtime/suggestion.h"

namespace declutter::launcher {
namespace {

struct Publication {
  const WiredModule* module;
  const Port* port;
};

using Publications = std::map<std::string, Publication>;

bool IsShared(const Port& port) { return port.channel == kModuleStatus.name; }

Publications CollectPublishers(const std::vector<WiredModule>& modules,
                               std::vector<Fault>* faults) {
  Publications publications;
  for (const WiredModule& module : modules) {
    for (const Port& output : module.outputs) {
      if (IsShared(output)) continue;
      const auto [found, is_new] =
          publications.emplace(output.channel, Publication{&module, &output});
      if (is_new) continue;
      faults->push_back({module.where, module.name + " publishes " + output.channel + ", as " +
                                           found->second.module->name + " does"});
    }
  }
  return publications;
}

void CheckInput(const WiredModule& module, const Port& input, const Publications& publications,
                const std::set<std::string>& external, std::vector<Fault>* faults) {
  if (IsShared(input)) return;
  const auto found = publications.find(input.channel);
  if (found == publications.end() && external.count(input.channel) != 0) return;
  if (found == publications.end()) {
    std::vector<std::string> channels;
    for (const auto& [channel, publication] : publications) channels.push_back(channel);
    faults->push_back({module.where, module.name + " consumes " + input.channel +
                                         ", which nothing publishes" +
                                         runtime::Suggestion(input.channel, channels)});
    return;
  }
  const Publication& publication = found->second;
  if (publication.port->type == input.type) return;
  faults->push_back({module.where, module.name + " consumes " + input.type + " on " +
                                       input.channel + ", where " + publication.module->name +
                                       " publishes " + publication.port->type});
}

// The modules on a cycle, each before those that must be ready first, beginning and ending with the
// same.
std::optional<std::vector<size_t>> FindCycle(const std::vector<WiredModule>& modules, size_t index,
                                             std::vector<size_t>* path,
                                             std::vector<bool>* is_done) {
  const auto begin = std::find(path->begin(), path->end(), index);
  if (begin != path->end()) {
    std::vector<size_t> cycle(begin, path->end());
    cycle.push_back(index);
    return cycle;
  }
  if ((*is_done)[index]) return std::nullopt;
  path->push_back(index);
  for (const size_t next : Predecessors(modules, index)) {
    if (auto cycle = FindCycle(modules, next, path, is_done)) return cycle;
  }
  path->pop_back();
  (*is_done)[index] = true;
  return std::nullopt;
}

void CheckCycles(const std::vector<WiredModule>& modules, std::vector<Fault>* faults) {
  std::vector<bool> is_done(modules.size());
  for (size_t i = 0; i < modules.size(); ++i) {
    std::vector<size_t> path;
    const auto cycle = FindCycle(modules, i, &path, &is_done);
    if (!cycle) continue;
    std::string text = "a cycle: " + modules[cycle->front()].name;
    for (size_t k = 1; k < cycle->size(); ++k) text += " -> " + modules[(*cycle)[k]].name;
    faults->push_back({modules[cycle->front()].where, text});
    return;
  }
}

}  // namespace

void Print(const std::vector<Fault>& faults) {
  for (const Fault& fault : faults) {
    std::cerr << (fault.where.empty() ? "" : fault.where + ": ") << fault.what << "\n";
  }
}

std::set<std::string> Unpublished(const std::vector<WiredModule>& modules) {
  std::vector<Fault> ignored;
  const Publications publications = CollectPublishers(modules, &ignored);
  std::set<std::string> unpublished;
  for (const WiredModule& module : modules) {
    for (const Port& input : module.inputs) {
      if (!IsShared(input) && publications.count(input.channel) == 0) {
        unpublished.insert(input.channel);
      }
    }
  }
  return unpublished;
}

std::vector<Fault> CheckWiring(const std::vector<WiredModule>& modules,
                               const std::set<std::string>& external) {
  std::vector<Fault> faults;
  const Publications publications = CollectPublishers(modules, &faults);
  for (const WiredModule& module : modules) {
    for (const Port& input : module.inputs) {
      CheckInput(module, input, publications, external, &faults);
    }
  }
  CheckCycles(modules, &faults);
  return faults;
}

std::vector<size_t> Downstream(const std::vector<WiredModule>& modules, size_t index) {
  std::vector<size_t> downstream;
  for (size_t i = 0; i < modules.size(); ++i) {
    if (IsSource(modules[i])) continue;
    const bool consumes =
        std::any_of(modules[i].inputs.begin(), modules[i].inputs.end(), [&](const Port& input) {
          return !IsShared(input) &&
                 std::any_of(modules[index].outputs.begin(), modules[index].outputs.end(),
                             [&](const Port& output) { return output.channel == input.channel; });
        });
    if (consumes) downstream.push_back(i);
  }
  return downstream;
}

std::vector<size_t> Predecessors(const std::vector<WiredModule>& modules, size_t index) {
  std::vector<size_t> predecessors = Downstream(modules, index);
  const std::vector<std::string>& after = modules[index].after;
  for (size_t i = 0; i < modules.size(); ++i) {
    const bool is_named = std::count(after.begin(), after.end(), modules[i].name) != 0;
    const bool is_new = std::count(predecessors.begin(), predecessors.end(), i) == 0;
    if (is_named && is_new) predecessors.push_back(i);
  }
  return predecessors;
}

bool IsSource(const WiredModule& module) {
  const bool publishes_depth =
      std::any_of(module.outputs.begin(), module.outputs.end(),
                  [](const Port& output) { return output.type == depth_frame_t::getTypeName(); });
  return !module.outputs.empty() &&
         std::all_of(module.inputs.begin(), module.inputs.end(), [&](const Port& input) {
           return IsShared(input) ||
                  (publishes_depth && input.type == object_list_t::getTypeName());
         });
}

}  // namespace declutter::launcher
