#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "launcher/command_line.h"
#include "launcher/find_program.h"
#include "launcher/load_graph.h"
#include "launcher/run.h"

namespace declutter::launcher {
namespace {

constexpr int kFailure = 1;
constexpr int kBadConfig = 2;

int Check(const CommandLine& line) {
  const bool is_run = line.verb == CommandLine::Verb::kRun;
  std::vector<Fault> faults;
  const auto graph = LoadGraph(line.graph, line.assignments, is_run, &faults);
  for (const Fault& fault : faults) {
    std::cerr << (fault.where.empty() ? "" : fault.where + ": ") << fault.what << "\n";
  }
  if (!graph) return kBadConfig;
  if (!is_run) {
    std::cout << graph->text;
    return std::cout.flush() ? 0 : kFailure;
  }
  const char* environment_url = std::getenv("LCM_DEFAULT_URL");
  RunOptions options{line.url, line.record, line.logs};
  if (options.url.empty() && environment_url != nullptr) options.url = environment_url;
  if (options.logs.empty()) options.logs = OwnFolder() + "/../../logs";
  return RunGraph(*graph, options);
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
  return Check(line);
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
