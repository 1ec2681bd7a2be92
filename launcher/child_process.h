#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "launcher/output_pipe.h"
#include "launcher/rotating_log.h"

namespace declutter::launcher {

// How a process ended.
struct Ending {
  int code = 0;     // of exit(); 1 when a signal ended it
  int signal = 0;   // that ended it; 0: none
  std::string how;  // for people: "exit code 1", "signal 11 (Segmentation fault)"
};

// How a program is started.
struct LaunchPlan {
  std::vector<std::string> command;  // the program's path, its arguments
  std::string log_path;              // appended to
  std::vector<std::string> env;      // NAME=VALUE, on top of ours
  std::vector<int> cpus;             // that it may run on; empty: all
  int nice = 0;
  int64_t max_memory_bytes = 0;  // of address space; 0: as ours
  int guard_fd = -1;             // of an OrphanGuard
};

// A child in a process group of its own that dies with the thread that started it, however that
// ends. What it prints goes to a log, stderr to ours as well; its stdin is what is sent to it.
class ChildProcess {
 public:
  // Throws std::runtime_error when the program or the log cannot be opened. Call from the main
  // thread.
  explicit ChildProcess(const LaunchPlan& plan);
  ~ChildProcess();  // kills what is left of its group
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  pid_t pid() const { return pid_; }  // -1 after its end

  // Readable when the child has written to stderr; -1 after the end of that.
  int stderr_fd() const { return stderr_.fd(); }

  // Copies what the child has printed, by whole lines.
  void ForwardOutput();

  // Writes to its stdin, once, and closes that.
  void Send(const std::string& text);

  // Sends a signal to the child and all it has started.
  void Signal(int signal);

  // How it ended, once; nothing while it runs. Ends what it has left behind in its group.
  std::optional<Ending> Reap();

 private:
  void CloseStdin();
  void Log(const std::string& lines);
  int End();  // of it and its group; returns the status of waitpid

  RotatingLog log_;
  OutputPipe stdout_;
  OutputPipe stderr_;
  int stdin_fd_ = -1;
  int guard_fd_ = -1;
  int log_fault_ = 0;  // errno of the last line
  pid_t pid_ = -1;
};

}  // namespace declutter::launcher
