#pragma once

#include <sys/types.h>

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

// A child in a process group of its own that dies with the thread that started it, however that
// ends. What it prints goes to a log, stderr to ours as well; its stdin is what is sent to it.
class ChildProcess {
 public:
  // Starts command[0], a path, with the arguments command[1...], appending to log_path. Throws
  // std::runtime_error when the program or the log cannot be opened. Call from the main thread.
  ChildProcess(const std::vector<std::string>& command, const std::string& log_path);
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

  RotatingLog log_;
  OutputPipe stdout_;
  OutputPipe stderr_;
  int stdin_fd_ = -1;
  pid_t pid_ = -1;
};

}  // namespace declutter::launcher
