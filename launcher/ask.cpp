#include "launcher/ask.h"

#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <thread>

#include "launcher/control_socket.h"
#include "launcher/find_program.h"
#include "launcher/load_graph.h"
#include "launcher/status_table.h"
#include "modules/runtime/suggestion.h"

namespace declutter::launcher {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

std::string FolderOf(const CommandLine& line) {
  const std::string folder =
      line.run_folder.empty() ? OwnFolder() + "/../../logs/latest" : line.run_folder;
  if (!fs::is_directory(folder)) throw std::runtime_error(folder + ": no graph has run there");
  return fs::canonical(folder);
}

int Send(const std::string& folder, const ControlRequest& request) {
  const ControlReply reply = AskLauncher(folder, request);
  if (!reply.text().empty()) std::cerr << "launcher: " << reply.text() << "\n";
  return reply.code();
}

bool Runs(const std::string& folder) {
  ControlRequest request;
  request.set_verb("status");
  try {
    AskLauncher(folder, request);
  } catch (const std::runtime_error&) {
    return false;
  }
  return true;
}

// Names of the processes that have logs.
std::vector<std::string> LogsIn(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".log") names.push_back(entry.path().stem());
  }
  return names;
}

// Prints a file from *position, which moves to its end; false when there is nothing.
bool PrintFrom(const std::string& path, std::streamoff* position) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file.tellg();
  if (!file || size <= *position) return false;
  file.seekg(*position);
  std::cout << file.rdbuf() << std::flush;
  *position = size;
  return true;
}

// Prints what is new in a log since *position. A shorter file is a new one: the rest of that before
// is in the older.
bool PrintNew(const std::string& path, std::streamoff* position) {
  std::error_code ignored;
  if (fs::file_size(path, ignored) < static_cast<std::uintmax_t>(*position)) {
    PrintFrom(path + ".1", position);
    *position = 0;
  }
  return PrintFrom(path, position);
}

}  // namespace

int ShowStatus(const CommandLine& line) {
  const std::string folder = FolderOf(line);
  ControlRequest request;
  request.set_verb("status");
  ControlReply reply = AskLauncher(folder, request);
  while (line.follows) {
    std::cout << (isatty(STDOUT_FILENO) != 0 ? "\033[H\033[2J" : "") << StatusTable(reply)
              << std::endl;
    std::this_thread::sleep_for(milliseconds(1000));
    if (!Runs(folder)) return 0;
    reply = AskLauncher(folder, request);
  }
  std::cout << StatusTable(reply) << std::flush;
  return reply.code();
}

int ShowLog(const CommandLine& line) {
  const std::string folder = FolderOf(line);
  const std::string path = folder + "/" + line.module + ".log";
  if (!fs::exists(path)) {
    throw runtime::ConfigError(folder + ": nothing named '" + line.module + "' has run there" +
                               runtime::Suggestion(line.module, LogsIn(folder)));
  }
  std::streamoff older_position = 0, position = 0;
  PrintFrom(path + ".1", &older_position);
  PrintFrom(path, &position);
  while (line.follows) {
    const bool runs = Runs(folder);
    if (!PrintNew(path, &position) && !runs) break;
    std::this_thread::sleep_for(milliseconds(200));
  }
  return std::cout.flush() ? 0 : 1;
}

int Order(const CommandLine& line) {
  ControlRequest request;
  request.set_verb(line.word);
  request.set_module(line.module);
  return Send(FolderOf(line), request);
}

int Swap(const CommandLine& line) {
  const std::string folder = FolderOf(line);
  const bool is_path = line.program.find('/') != std::string::npos;
  const auto program =
      is_path ? std::optional<std::string>(fs::absolute(line.program)) : FindProgram(line.program);
  if (!program) throw runtime::ConfigError("no program '" + line.program + "'");
  std::vector<Fault> faults;
  ProgramCatalog catalog;
  const auto graph = LoadGraph(folder + "/graph.textproto", line.assignments,
                               {{line.module, *program}}, &catalog, &faults);
  Print(faults);
  if (!graph) return 2;
  ControlRequest request;
  request.set_verb("swap");
  request.set_module(line.module);
  request.set_program(*program);
  request.set_graph_text(graph->Text());
  request.set_versions_text(graph->Versions());
  for (const ResolvedModule& resolved : graph->modules) {
    if (resolved.module.name() != line.module) continue;
    request.set_config_text(resolved.config_text);
    Print(resolved.missing);
    if (!resolved.missing.empty()) return 2;
  }
  return Send(folder, request);
}

}  // namespace declutter::launcher
