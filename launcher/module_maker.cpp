#include "launcher/module_maker.h"

#include <signal.h>

#include <chrono>
#include <utility>

namespace declutter::launcher {
namespace {

int SignalOf(const std::string& name) {
  static const std::map<std::string, int> signals = {
      {"SIGTERM", SIGTERM}, {"SIGINT", SIGINT}, {"SIGQUIT", SIGQUIT}, {"SIGUSR1", SIGUSR1}};
  return signals.at(name);
}

}  // namespace

std::unique_ptr<ModuleProcess> ModuleMaker::Make(const Module& module) const {
  return Make(module, folder_.ConfigPath(module.name()));
}

std::unique_ptr<ModuleProcess> ModuleMaker::Make(const Module& module,
                                                 const std::string& config_path) const {
  LaunchPlan plan;
  plan.command = {module.program(), "--name", module.name(), "--config", config_path};
  for (const Remap& remap : module.remap()) {
    plan.command.insert(plan.command.end(), {"--remap", remap.from() + "=" + remap.to()});
  }
  if (graph_.lossless) plan.command.push_back("--lossless");
  plan.command.insert(plan.command.end(), module.arg().begin(), module.arg().end());
  plan.log_path = folder_.LogPath(module.name());
  plan.env = {module.env().begin(), module.env().end()};
  plan.cpus = {module.cpu().begin(), module.cpu().end()};
  plan.nice = module.nice();
  plan.guard_fd = guard_.fd();
  plan.max_memory_bytes = int64_t{module.memory_limit_mb()} << 20;
  return std::make_unique<ModuleProcess>(module.name(), std::move(plan),
                                         SignalOf(module.stop_signal()));
}

std::unique_ptr<ModuleProcess> ModuleMaker::Make(const ControlRequest& request) {
  for (const ResolvedModule& resolved : graph_.modules) {
    if (resolved.module.name() != request.module()) continue;
    Module module = resolved.module;
    module.set_program(request.program());
    requests_[module.name()] = request;
    return Make(module, folder_.WriteConfig(module.name() + ".swap" + std::to_string(++num_made_),
                                            request.config_text()));
  }
  return nullptr;
}

void ModuleMaker::Adopt(const std::string& module) {
  const ControlRequest& request = requests_.at(module);
  folder_.WriteGraph(request.graph_text(), request.versions_text());
  if (recorder_ == nullptr) return;
  recorder_->Tell(InfoOf(request.versions_text(), request.graph_text()));
}

run_info_t InfoOf(const std::string& versions, const std::string& graph) {
  run_info_t info = {};
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  info.utime = std::chrono::duration_cast<std::chrono::microseconds>(now).count();
  info.versions = versions;
  info.graph = graph;
  return info;
}

}  // namespace declutter::launcher
