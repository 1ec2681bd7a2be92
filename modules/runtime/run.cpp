#include "modules/runtime/run.h"

#include <google/protobuf/text_format.h>
#include <malloc.h>
#include <sys/eventfd.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "modules/runtime/command_line.h"
#include "modules/runtime/config.h"
#include "modules/runtime/network.h"
#include "modules/runtime/reference.h"
#include "modules/runtime/replay.h"
#include "modules/runtime/shell.h"
#include "modules/runtime/suggestion.h"

namespace declutter::runtime {
namespace {

using google::protobuf::Message;

constexpr int kClean = 0;
constexpr int kFailure = 1;
constexpr int kBadConfig = 2;

// The last line of defence against input that makes a process allocate without end. A limit that
// was set for this process counts instead.
void LimitMemory() {
#ifndef __SANITIZE_ADDRESS__
  constexpr rlim_t kMaxBytes = rlim_t{4} << 30;
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur != RLIM_INFINITY) return;
  limit.rlim_cur = kMaxBytes;
  setrlimit(RLIMIT_AS, &limit);
#endif
}

// Every frame needs the same large buffers: memory that is freed stays with the process. Giving it
// back and taking it again costs hundreds of page faults a frame.
void KeepFreedMemory() {
  constexpr int kMaxBlock = 32 << 20;  // the largest the allocator takes from its heap
  constexpr int kMaxUnused = 256 << 20;
  mallopt(M_MMAP_THRESHOLD, kMaxBlock);
  mallopt(M_TRIM_THRESHOLD, kMaxUnused);
}

// Signals for the end become readable on the descriptor returned; to be called before there are
// threads. SIGHUP, the end of a terminal, does not concern a process of a graph.
int TakeSignals() {
  std::signal(SIGHUP, SIG_IGN);
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signalfd(-1, &signals, SFD_CLOEXEC);
}

std::string ReadFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file.is_open() || std::filesystem::is_directory(path))
    throw ConfigError(path + ": cannot be read");
  return text.str();
}

void ResolveConfig(const CommandLine& line, Message* config) {
  if (!line.config_file.empty()) {
    ParseConfig(ReadFile(line.config_file), line.config_file, config);
  }
  for (const std::string& assignment : line.assignments) SetField(assignment, config);
}

void CheckRemap(const CommandLine& line, const Shell& shell) {
  for (const auto& [from, to] : line.remap) {
    const auto& channels = shell.channels();
    if (std::find(channels.begin(), channels.end(), from) != channels.end()) continue;
    throw ConfigError("--remap " + from + '=' + to + ": the module has no such channel" +
                      Suggestion(from, channels));
  }
}

int RunLive(const CommandLine& line, Shell* shell, std::shared_ptr<void> module) {
  const int signal_fd = TakeSignals();
  const int end_fd = eventfd(0, EFD_CLOEXEC);
  if (signal_fd < 0 || end_fd < 0) throw std::runtime_error("no descriptors left");
  Network network(shell);
  shell->Connect([&network](const std::string& channel, const Bytes& message) {
    network.Publish(channel, message);
  });
  network.Subscribe();
  int code = kClean;
  std::thread io;
  const auto serve = [&] {
    const int release_fd = line.hold ? STDIN_FILENO : -1;
    io = std::thread([=, &network] { network.Serve(signal_fd, end_fd, release_fd); });
  };
  try {
    if (line.hold) {
      shell->Hold();
      serve();
      shell->AwaitRelease();
    }
    if (!shell->is_closed()) shell->Start();
    if (!line.hold) serve();
    shell->Work();
  } catch (const ConfigError& error) {
    shell->Fail(error.what());
    code = kBadConfig;
  } catch (const std::exception& error) {
    shell->Fail(error.what());
  }
  eventfd_write(end_fd, 1);
  if (io.joinable()) io.join();
  module.reset();
  if (code == kClean && shell->failed()) code = kFailure;
  shell->PublishStatus(code == kClean ? Shell::State::kFinished : Shell::State::kFailed);
  return code;
}

int RunReplay(const CommandLine& line, Shell* shell, std::shared_ptr<void> module) {
  Replay(line.replay, line.record, shell);
  if (const std::int64_t num = shell->num_rejected(); num > 0) {
    shell->Fail(line.replay + ": " + std::to_string(num) + " messages or frames were rejected");
  }
  module.reset();
  return shell->failed() ? kFailure : kClean;
}

void Print(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    throw std::runtime_error("stdout cannot be written");
  }
}

int Act(const CommandLine& line, Message* config, const ModuleFactory& factory) {
  using Action = CommandLine::Action;
  const bool describes = line.action == Action::kDescribe || line.action == Action::kHelp;
  if (!describes) ResolveConfig(line, config);
  if (line.action == Action::kPrintConfig) {
    Print(ConfigText(*config));
    return kClean;
  }
  const bool lossless = line.lossless || !line.replay.empty();
  Shell shell({line.name, line.program, line.remap, lossless});
  Bus bus(&shell);
  if (!describes) {
    CheckComplete(*config);
    LimitMemory();
    KeepFreedMemory();
  }
  std::shared_ptr<void> module = factory(bus);
  CheckRemap(line, shell);
  if (!describes) {
    return line.replay.empty() ? RunLive(line, &shell, std::move(module))
                               : RunReplay(line, &shell, std::move(module));
  }
  const ModuleDescription description = Describe(shell, *config->GetDescriptor());
  Print(line.action == Action::kHelp ? Help(description, *config) : description.DebugString());
  return kClean;
}

}  // namespace

int RunModule(int argc, char** argv, Message* config, const ModuleFactory& factory) {
  std::string name = argc > 0 ? argv[0] : "module";
  name.erase(0, name.find_last_of('/') + 1);
  try {
    const CommandLine line = ParseCommandLine(argc, argv);
    name = line.name;
    return Act(line, config, factory);
  } catch (const ConfigFileError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return kBadConfig;
  } catch (const ConfigError& error) {
    std::fprintf(stderr, "%s: %s\n", name.c_str(), error.what());
    return kBadConfig;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name.c_str(), error.what());
    return kFailure;
  }
}

}  // namespace declutter::runtime
