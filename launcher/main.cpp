#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "launcher/ask.h"
#include "launcher/command_line.h"
#include "launcher/doctor.h"
#include "launcher/dot.h"
#include "launcher/find_program.h"
#include "launcher/load_graph.h"
#include "launcher/plan_replay.h"
#include "launcher/run.h"
#include "launcher/selection.h"

namespace declutter::launcher {
namespace {

constexpr int kFailure = 1;
constexpr int kBadConfig = 2;

std::string DefaultLogs() { return OwnFolder() + "/../../logs"; }

int Run(const CommandLine& line, ResolvedGraph graph) {
  const char* environment_url = std::getenv("LCM_DEFAULT_URL");
  RunOptions options{line.url, line.record, line.logs};
  options.is_isolated = line.is_isolated;
  if (options.url.empty() && environment_url != nullptr) options.url = environment_url;
  if (options.logs.empty()) options.logs = DefaultLogs();
  Select(line.only, line.without, &graph);
  if (!line.replay.empty()) options.replay = PlanReplay(line, &graph);
  MakeWhole(&graph);
  bool is_complete = true;
  for (const ResolvedModule& module : graph.modules) {
    Print(module.missing);
    is_complete = is_complete && module.missing.empty();
  }
  return is_complete ? RunGraph(graph, options) : kBadConfig;
}

int CheckOrRun(const CommandLine& line) {
  std::error_code ignored;
  if (std::filesystem::exists(std::filesystem::symlink_status(line.record, ignored))) {
    throw runtime::ConfigError("--record " + line.record + ": exists already");
  }
  std::vector<Fault> faults;
  ProgramCatalog catalog;
  const auto graph = LoadGraph(line.graph, line.assignments, {}, &catalog, &faults);
  Print(faults);
  if (!graph) return kBadConfig;
  if (line.verb == CommandLine::Verb::kRun) return Run(line, *graph);
  std::vector<WiredModule> wiring;
  for (const ResolvedModule& module : graph->modules) wiring.push_back(module.wiring);
  std::cout << (line.draws ? Dot(wiring) : graph->Text());
  return std::cout.flush() ? 0 : kFailure;
}

int Act(const std::vector<std::string>& arguments) {
  using Verb = CommandLine::Verb;
  const CommandLine line = ParseCommandLine(arguments);
  switch (line.verb) {
    case Verb::kHelp:
      std::cout << HelpText();
      return 0;
    case Verb::kCheck:
    case Verb::kRun:
      return CheckOrRun(line);
    case Verb::kStatus:
      return ShowStatus(line);
    case Verb::kLogs:
      return ShowLog(line);
    case Verb::kSwap:
      return Swap(line);
    case Verb::kDoctor:
      return Examine(line.logs.empty() ? DefaultLogs() : line.logs);
    case Verb::kStart:
    case Verb::kStop:
    case Verb::kRestart:
      break;
  }
  return Order(line);
}

}  // namespace
}  // namespace declutter::launcher

int main(int argc, char** argv) {
  using namespace declutter;
  try {
    return launcher::Act({argv + 1, argv + argc});
  } catch (const runtime::ConfigError& error) {
    std::cerr << "launcher: " << error.what() << "\n";
    return launcher::kBadConfig;
  } catch (const std::exception& error) {
    std::cerr << "launcher: " << error.what() << "\n";
    return launcher::kFailure;
  }
}
