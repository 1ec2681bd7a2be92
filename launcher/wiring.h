#pragma once

#include <set>
#include <string>
#include <vector>

namespace declutter::launcher {

// What is wrong, and where it was written: "file:line:column" or "--set module.field=value".
struct Fault {
  std::string where;
  std::string what;
};

// To stderr, a line each.
void Print(const std::vector<Fault>& faults);

// A channel that a module publishes or consumes, and the type of its messages.
struct Port {
  std::string channel;
  std::string type;
};

// A module as the channels see it, its channels named as in the graph.
struct WiredModule {
  std::string name;
  std::string where;  // of its block in the graph
  std::vector<Port> inputs;
  std::vector<Port> outputs;
  std::vector<std::string> after = {};  // modules that must be ready before this starts
};

// The channels' faults: two publishers of one, none of one that is consumed, two types on one, a
// cycle, of messages or of starting one after the other. What only releases a source may close a
// cycle; MODULE_STATUS is everybody's.
// external: channels that may be consumed though nothing here publishes them.
std::vector<Fault> CheckWiring(const std::vector<WiredModule>& modules,
                               const std::set<std::string>& external = {});

// Channels that are consumed and that nothing here publishes.
std::set<std::string> Unpublished(const std::vector<WiredModule>& modules);

// Indices of the modules that consume what module number index publishes, releases not counted.
std::vector<size_t> Downstream(const std::vector<WiredModule>& modules, size_t index);

// Indices of the modules that must be ready before module number index starts: those downstream,
// and those that the graph says.
std::vector<size_t> Predecessors(const std::vector<WiredModule>& modules, size_t index);

// What it publishes comes from outside the graph: it consumes nothing, or it publishes depth images
// and consumes but their objects, as these tell that a frame is through and release the next.
bool IsSource(const WiredModule& module);

}  // namespace declutter::launcher
