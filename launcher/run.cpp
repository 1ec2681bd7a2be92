#include "launcher/run.h"

#include <signal.h>

#include <chrono>
#include <cstdlib>
#include <map>
#include <memory>
#include <stdexcept>
#include <utility>

#include "launcher/find_program.h"
#include "launcher/module_process.h"
#include "launcher/network.h"
#include "launcher/recorder.h"
#include "launcher/run_folder.h"
#include "launcher/session.h"
#include "launcher/url_claim.h"
#include "launcher/wire.h"

namespace declutter::launcher {
namespace {

// No names of modules: these have no dash.
constexpr const char* kLogger = "lcm-logger";
constexpr const char* kFeeder = "log-feeder";

int SignalOf(const std::string& name) {
  static const std::map<std::string, int> signals = {
      {"SIGTERM", SIGTERM}, {"SIGINT", SIGINT}, {"SIGQUIT", SIGQUIT}, {"SIGUSR1", SIGUSR1}};
  return signals.at(name);
}

std::unique_ptr<ModuleProcess> MakeModule(const Module& module, const std::string& config_path,
                                          bool lossless, const RunFolder& folder) {
  LaunchPlan plan;
  plan.command = {module.program(), "--name", module.name(), "--config", config_path};
  for (const Remap& remap : module.remap()) {
    plan.command.insert(plan.command.end(), {"--remap", remap.from() + "=" + remap.to()});
  }
  if (lossless) plan.command.push_back("--lossless");
  plan.command.insert(plan.command.end(), module.arg().begin(), module.arg().end());
  plan.log_path = folder.LogPath(module.name());
  plan.env = {module.env().begin(), module.env().end()};
  plan.cpus = {module.cpu().begin(), module.cpu().end()};
  plan.nice = module.nice();
  plan.max_memory_bytes = int64_t{module.memory_limit_mb()} << 20;
  return std::make_unique<ModuleProcess>(module.name(), std::move(plan),
                                         SignalOf(module.stop_signal()));
}

Node PlanNode(const Module& module) {
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

// As a pattern. What is recorded is heard, to be counted.
std::string HeardChannels(const RunOptions& options) {
  if (!options.record.empty()) return ".*";
  std::string pattern = kModuleStatus.name;
  if (options.replay) {
    for (const std::string& channel : options.replay->awaited) pattern += "|" + channel;
  }
  return "(" + pattern + ")";
}

run_info_t InfoOf(const ResolvedGraph& graph) {
  run_info_t info = {};
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  info.utime = std::chrono::duration_cast<std::chrono::microseconds>(now).count();
  for (const ResolvedModule& module : graph.modules) {
    info.versions += module.module.program() + " " + module.version + "\n";
  }
  info.graph = graph.Text();
  return info;
}

// Where this run is recorded to; nothing when it is not.
std::optional<Recording> PlanRecording(const ResolvedGraph& graph, const RunOptions& options,
                                       const RunFolder& folder) {
  if (!options.record.empty()) return Recording{options.record};
  if (!graph.logger) return std::nullopt;
  return Recording{folder.path() + "/" + graph.logger->name() + ".lcmlog", true,
                   graph.logger->min_free_mb()};
}

std::unique_ptr<Process> MakeRecorder(const Recording& recording, const ResolvedGraph& graph,
                                      const RunOptions& options, const RunFolder& folder,
                                      Wire* wire) {
  const auto logger = FindProgram(kLogger);
  if (!logger) throw std::runtime_error(std::string(kLogger) + " is not installed");
  CheckFreeSpace(recording);
  LaunchPlan plan;
  // Of its flags only the long ones with = are read as documented, of -i only the short one.
  plan.command = {*logger, "--quiet", "--lcm-url=" + options.url};
  if (recording.is_split) {
    plan.command.push_back("-i");
    plan.command.push_back("--split-mb=" + std::to_string(graph.logger->split_mb()));
  }
  plan.command.push_back(recording.path);
  plan.log_path = folder.LogPath(kLogger);
  return std::make_unique<Recorder>(std::move(plan), recording, InfoOf(graph), wire);
}

// What --record asks for is the purpose of a run; a logger in the graph is its companion.
Node PlanRecorder(const RunOptions& options) {
  Node node{kLogger, {}};
  if (!options.record.empty()) return node;
  node.is_required = false;
  node.restart.when = RestartRule::When::kOnFailure;
  return node;
}

class ModuleMaker : public SuccessorMaker {
 public:
  ModuleMaker(const ResolvedGraph& graph, const RunFolder& folder)
      : graph_(graph), folder_(folder) {}

  std::unique_ptr<ModuleProcess> Make(const ControlRequest& request) override {
    for (const ResolvedModule& resolved : graph_.modules) {
      if (resolved.module.name() != request.module()) continue;
      Module module = resolved.module;
      module.set_program(request.program());
      graph_texts_[module.name()] = request.graph_text();
      const std::string config = folder_.WriteConfig(
          module.name() + ".swap" + std::to_string(++num_made_), request.config_text());
      return MakeModule(module, config, graph_.lossless, folder_);
    }
    return nullptr;
  }

  void Adopt(const std::string& module) override { folder_.WriteGraph(graph_texts_.at(module)); }

 private:
  const ResolvedGraph& graph_;
  const RunFolder& folder_;
  std::map<std::string, std::string> graph_texts_;  // by module
  int num_made_ = 0;
};

}  // namespace

std::vector<Node> PlanNodes(const ResolvedGraph& graph, const RunOptions& options) {
  const bool has_recorder = !options.record.empty() || graph.logger;
  std::vector<WiredModule> wiring;
  for (const ResolvedModule& resolved : graph.modules) wiring.push_back(resolved.wiring);
  std::vector<Node> nodes;
  if (has_recorder) nodes.push_back(PlanRecorder(options));
  for (size_t i = 0; i < graph.modules.size(); ++i) {
    const Module& module = graph.modules[i].module;
    Node node = PlanNode(module);
    node.is_source = IsSource(wiring[i]);
    for (const size_t consumer : Downstream(wiring, i)) {
      node.downstream.push_back(wiring[consumer].name);
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

int RunGraph(const ResolvedGraph& graph, const RunOptions& requested) {
  RunOptions options = requested;
  options.url = options.url.empty() ? ChooseUrl() : WithReceiveBuffer(options.url);
  if (options.is_isolated) Isolate();
  const UrlClaim claim(options.url);
  EnsureMulticast(options.url);
  setenv("LCM_DEFAULT_URL", options.url.c_str(), 1);
  const RunFolder folder(options.logs, graph);
  HoldSignals();
  Wire wire(options.url);
  wire.Subscribe(HeardChannels(options));

  ProcessMap processes;
  for (const ResolvedModule& resolved : graph.modules) {
    const std::string& name = resolved.module.name();
    processes[name] = MakeModule(resolved.module, folder.ConfigPath(name), graph.lossless, folder);
  }
  if (const auto recording = PlanRecording(graph, options, folder)) {
    processes[kLogger] = MakeRecorder(*recording, graph, options, folder, &wire);
  }
  if (options.replay) processes[kFeeder] = std::make_unique<LogFeeder>(*options.replay, &wire);
  const bool is_finite = graph.lossless && !(options.replay && options.replay->loops);
  Supervisor supervisor(PlanNodes(graph, options), is_finite);
  ControlSocket control(folder.path());
  ModuleMaker maker(graph, folder);
  return Session(std::move(supervisor), std::move(processes), &wire, &control, &maker).Run();
}

}  // namespace declutter::launcher
