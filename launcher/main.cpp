#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "launcher/command_line.h"
#include "launcher/find_program.h"
#include "launcher/load_graph.h"
#include "launcher/plan_replay.h"
#include "launcher/run.h"

namespace declutter::launcher {
namespace {

constexpr int kFailure = 1;
constexpr int kBadConfig = 2;

void Print(const std::vector<Fault>& faults) {
  for (const Fault& fault : faults) {
    std::cerr << (fault.where.empty() ? "" : fault.where + ": ") << fault.what << "\n";
  }
}

int Run(const CommandLine& line, ResolvedGraph graph) {
  const char* environment_url = std::getenv("LCM_DEFAULT_URL");
  RunOptions options{line.url, line.record, line.logs};
  if (options.url.empty() && environment_url != nullptr) options.url = environment_url;
  if (options.logs.empty()) options.logs = OwnFolder() + "/../../logs";
  if (!line.replay.empty()) options.replay = PlanReplay(line.replay, line.from, &graph);
  bool is_complete = true;
  for (const ResolvedModule& module : graph.modules) {
    Print(module.missing);
    is_complete = is_complete && module.missing.empty();
  }
  return is_complete ? RunGraph(graph, options) : kBadConfig;
}

int Act(const std::vector<std::string>& arguments) {
  const CommandLine line = ParseCommandLine(arguments);
  if (line.verb == CommandLine::Verb::kHelp) {
    std::cout << HelpText();
    return 0;
  }
  std::error_code ignored;
  if (std::filesystem::exists(std::filesystem::symlink_status(line.record, ignored))) {
    throw runtime::ConfigError("--record " + line.record + ": exists already");
  }
  std::vector<Fault> faults;
  const auto graph = LoadGraph(line.graph, line.assignments, &faults);
  Print(faults);
  if (!graph) return kBadConfig;
  if (line.verb == CommandLine::Verb::kRun) return Run(line, *graph);
  std::cout << graph->text;
  return std::cout.flush() ? 0 : kFailure;
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
