#include "launcher/run.h"

#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <utility>

#include "launcher/find_program.h"
#include "launcher/launcher_log.h"
#include "launcher/module_maker.h"
#include "launcher/network.h"
#include "launcher/orphan_guard.h"
#include "launcher/plan_nodes.h"
#include "launcher/recorder.h"
#include "launcher/run_folder.h"
#include "launcher/session.h"
#include "launcher/url_claim.h"
#include "launcher/wire.h"
#include "modules/runtime/config_error.h"

namespace declutter::launcher {
namespace {

// As a pattern. What is recorded is heard, to be counted.
std::string HeardChannels(const RunOptions& options) {
  if (!options.record.empty()) return ".*";
  std::string pattern = kModuleStatus.name;
  if (options.replay) {
    for (const std::string& channel : options.replay->awaited) pattern += "|" + channel;
  }
  return "(" + pattern + ")";
}

// Where this run is recorded to; nothing when it is not.
std::optional<Recording> PlanRecording(const ResolvedGraph& graph, const RunOptions& options,
                                       const RunFolder& folder) {
  if (!options.record.empty()) return Recording{options.record};
  if (!graph.logger) return std::nullopt;
  return Recording{folder.path() + "/" + graph.logger->name() + ".lcmlog", true,
                   graph.logger->min_free_mb()};
}

std::unique_ptr<Recorder> MakeRecorder(const Recording& recording, const ResolvedGraph& graph,
                                       const std::string& url, const RunFolder& folder,
                                       const OrphanGuard& guard, Wire* wire) {
  const auto logger = FindProgram(kLogger);
  if (!logger) throw std::runtime_error(std::string(kLogger) + " is not installed");
  CheckFreeSpace(recording);
  LaunchPlan plan;
  // Of its flags only the long ones with = are read as documented, of -i only the short one.
  plan.command = {*logger, "--quiet", "--lcm-url=" + url};
  if (recording.is_split) {
    plan.command.push_back("-i");
    plan.command.push_back("--split-mb=" + std::to_string(graph.logger->split_mb()));
  }
  plan.command.push_back(recording.path);
  plan.log_path = folder.LogPath(kLogger);
  plan.guard_fd = guard.fd();
  return std::make_unique<Recorder>(std::move(plan), recording,
                                    InfoOf(graph.Versions(), graph.Text()), wire);
}

// Of the url that is given, else of one that nobody else uses, which url becomes.
std::unique_ptr<UrlClaim> Claim(std::string* url) {
  constexpr int kMaxRefused = 20;
  const bool is_given = !url->empty();
  for (int num_refused = 0;; ++num_refused) {
    *url = is_given ? WithReceiveBuffer(*url) : ChooseUrl(num_refused);
    try {
      return std::make_unique<UrlClaim>(*url);
    } catch (const runtime::ConfigError&) {
      // Another launcher has chosen the same port at this moment.
      if (is_given || num_refused == kMaxRefused) throw;
    }
  }
}

}  // namespace

int RunGraph(const ResolvedGraph& graph, const RunOptions& requested) {
  RunOptions options = requested;
  const OrphanGuard guard;
  if (options.is_isolated) Isolate();
  const std::unique_ptr<UrlClaim> claim = Claim(&options.url);
  options.is_isolated = EnsureMulticast(options.url) || options.is_isolated;
  setenv("LCM_DEFAULT_URL", options.url.c_str(), 1);
  const RunFolder folder(options.logs, graph);
  LauncherLog log(folder.LogPath("launcher"));
  HoldSignals();
  Wire wire(options.url);
  wire.Subscribe(HeardChannels(options));

  ProcessMap processes;
  ModuleMaker maker(graph, folder, guard);
  for (const ResolvedModule& resolved : graph.modules) {
    processes[resolved.module.name()] = maker.Make(resolved.module);
  }
  if (const auto recording = PlanRecording(graph, options, folder)) {
    auto recorder = MakeRecorder(*recording, graph, options.url, folder, guard, &wire);
    maker.SetRecorder(recorder.get());
    processes[kLogger] = std::move(recorder);
  }
  if (options.replay) processes[kFeeder] = std::make_unique<LogFeeder>(*options.replay, &wire);
  const bool is_finite = graph.lossless && !(options.replay && options.replay->loops);
  Supervisor supervisor(PlanNodes(graph, options), is_finite);
  ControlSocket control(folder.path());
  const std::string place = options.url + (options.is_isolated ? " in a network of its own" : "") +
                            ", logs in " + folder.path();
  log.Say(place);
  return Session({&wire, &control, &maker, &log, place}, std::move(supervisor),
                 std::move(processes))
      .Run();
}

}  // namespace declutter::launcher
