#include "launcher/plan_nodes.h"

#include <utility>

namespace declutter::launcher {
namespace {

Node PlanModule(const Module& module) {
  using When = RestartRule::When;
  const When when = module.restart() == "always"       ? When::kAlways
                    : module.restart() == "on_failure" ? When::kOnFailure
                                                       : When::kNever;
  Node node{module.name(), {}};
  node.start_limit_s = module.start_limit_s();
  node.grace_period_s = module.grace_period_s();
  node.is_required = module.required();
  node.restart = {when, module.restart_delay_s(), module.max_restart_delay_s(),
                  module.max_restarts()};
  node.hang_limit_s = module.hang_limit_s();
  return node;
}

// What --record asks for is the purpose of a run; a logger in the graph is its companion.
Node PlanRecorder(const RunOptions& options) {
  Node node{kLogger, {}};
  if (!options.record.empty()) return node;
  node.is_required = false;
  node.restart.when = RestartRule::When::kOnFailure;
  return node;
}

}  // namespace

std::vector<Node> PlanNodes(const ResolvedGraph& graph, const RunOptions& options) {
  const bool has_recorder = !options.record.empty() || graph.logger;
  std::vector<WiredModule> wiring;
  for (const ResolvedModule& resolved : graph.modules) wiring.push_back(resolved.wiring);
  std::vector<Node> nodes;
  if (has_recorder) nodes.push_back(PlanRecorder(options));
  for (size_t i = 0; i < graph.modules.size(); ++i) {
    Node node = PlanModule(graph.modules[i].module);
    node.is_source = IsSource(wiring[i]);
    for (const size_t before : Predecessors(wiring, i)) {
      node.downstream.push_back(wiring[before].name);
    }
    if (has_recorder) node.downstream.push_back(kLogger);
    nodes.push_back(std::move(node));
  }
  if (options.replay) {
    Node feeder{kFeeder, {}, true};
    for (const Node& node : nodes) feeder.downstream.push_back(node.name);
    nodes.push_back(std::move(feeder));
  }
  return nodes;
}

}  // namespace declutter::launcher
