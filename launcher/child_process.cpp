#include "launcher/child_process.h"

#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <utility>

#include "launcher/console.h"
#include "launcher/orphan_guard.h"

namespace declutter::launcher {
namespace {

constexpr int kExecFailed = 127;
constexpr int64_t kMaxLog = 10 << 20;  // [byte] of each of two files

// A pipe whose ends no other child inherits.
std::pair<int, int> OpenPipe() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error(strerror(errno));
  return {ends[0], ends[1]};
}

// Our environment with these variables on top.
std::vector<std::string> EnvironmentWith(const std::vector<std::string>& variables) {
  std::vector<std::string> environment = variables;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    const std::string name = text.substr(0, text.find('=') + 1);
    const bool is_replaced =
        std::any_of(variables.begin(), variables.end(),
                    [&](const std::string& variable) { return variable.rfind(name, 0) == 0; });
    if (!is_replaced) environment.push_back(text);
  }
  return environment;
}

std::vector<char*> Pointers(const std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

// The rest is called between fork and exec: only calls that are safe in a child of a process with
// threads.

void Note(const char* text) {
  if (write(STDERR_FILENO, text, strlen(text)) < 0) return;  // nobody to tell
}

void Limit(const LaunchPlan& plan) {
  if (plan.nice != 0 && setpriority(PRIO_PROCESS, 0, plan.nice) != 0) {
    Note("launcher: the priority that the graph asks for needs root\n");
  }
  if (!plan.cpus.empty()) {
    cpu_set_t cpus;
    CPU_ZERO(&cpus);
    for (const int cpu : plan.cpus) CPU_SET(static_cast<size_t>(cpu), &cpus);
    if (sched_setaffinity(0, sizeof(cpus), &cpus) != 0) {
      Note("launcher: the cores that the graph asks for are not to be had\n");
    }
  }
  rlimit limit = {};
  const auto max_bytes = static_cast<rlim_t>(plan.max_memory_bytes);
  if (max_bytes == 0 || getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_max < max_bytes) return;
  limit.rlim_cur = limit.rlim_max = max_bytes;
  setrlimit(RLIMIT_AS, &limit);
}

[[noreturn]] void Become(char* const argv[], char* const env[], const LaunchPlan& plan,
                         pid_t parent, const int streams[3], int fault_fd) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  // The parent may have died before the line above: then nobody would end us.
  if (getppid() != parent) _exit(kExecFailed);
  setpgid(0, 0);
  OrphanGuard::Enter(plan.guard_fd, getpid());
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  signal(SIGPIPE, SIG_DFL);
  for (int fd = 0; fd < 3; ++fd) dup2(streams[fd], fd);
  Limit(plan);
  execve(argv[0], argv, env);
  const int fault = errno;
  if (write(fault_fd, &fault, sizeof(fault)) < 0) _exit(kExecFailed);
  _exit(kExecFailed);
}

// The errno of a failed exec, 0 when it went well and the pipe was closed by it.
int ExecFault(int fd) {
  int fault = 0;
  ssize_t num_read;
  do {
    num_read = read(fd, &fault, sizeof(fault));
  } while (num_read < 0 && errno == EINTR);
  return num_read == sizeof(fault) ? fault : 0;
}

}  // namespace

ChildProcess::ChildProcess(const LaunchPlan& plan)
    : log_(plan.log_path, kMaxLog), guard_fd_(plan.guard_fd) {
  const std::vector<char*> argv = Pointers(plan.command);
  const std::vector<std::string> environment = EnvironmentWith(plan.env);
  const std::vector<char*> env = Pointers(environment);
  const auto [stdin_read_end, stdin_write_end] = OpenPipe();
  stdin_fd_ = stdin_write_end;
  const auto [fault_read_end, fault_write_end] = OpenPipe();
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ == 0) {
    const int streams[] = {stdin_read_end, stdout_.child_end(), stderr_.child_end()};
    Become(argv.data(), env.data(), plan, parent, streams, fault_write_end);
  }
  close(stdin_read_end);
  close(fault_write_end);
  stdout_.CloseChildEnd();
  stderr_.CloseChildEnd();
  const int fault = pid_ < 0 ? errno : ExecFault(fault_read_end);
  close(fault_read_end);
  if (fault == 0) return;
  if (pid_ > 0) End();
  CloseStdin();
  throw std::runtime_error(plan.command[0] + ": " + strerror(fault));
}

ChildProcess::~ChildProcess() {
  if (pid_ > 0) End();
  CloseStdin();
}

// While it is unreaped its number belongs to its group: what it left there can be ended safely.
int ChildProcess::End() {
  kill(-pid_, SIGKILL);
  kill(pid_, SIGKILL);  // had it no group yet
  int status = 0;
  siginfo_t state = {};
  waitid(P_PID, static_cast<id_t>(pid_), &state, WEXITED | WNOWAIT);
  OrphanGuard::Leave(guard_fd_, pid_);
  waitpid(pid_, &status, 0);
  pid_ = -1;
  return status;
}

void ChildProcess::CloseStdin() {
  if (stdin_fd_ >= 0) close(std::exchange(stdin_fd_, -1));
}

void ChildProcess::Send(const std::string& text) {
  if (stdin_fd_ < 0) return;
  WriteAll(stdin_fd_, text);
  CloseStdin();
}

void ChildProcess::Log(const std::string& lines) {
  const int fault = log_.Write(lines);
  if (fault != 0 && log_fault_ == 0) {
    WriteToConsole("launcher: " + log_.path() + ": " + strerror(fault) +
                   "; what its process prints is lost\n");
  }
  log_fault_ = fault;
}

void ChildProcess::ForwardOutput() {
  stdout_.Forward([this](const std::string& lines) { Log(lines); });
  stderr_.Forward([this](const std::string& lines) {
    Log(lines);
    WriteToConsole(lines);
  });
}

void ChildProcess::Signal(int signal) {
  if (pid_ > 0) kill(-pid_, signal);
}

std::optional<Ending> ChildProcess::Reap() {
  siginfo_t state = {};
  if (pid_ < 0) return std::nullopt;
  if (waitid(P_PID, static_cast<id_t>(pid_), &state, WEXITED | WNOHANG | WNOWAIT) != 0 ||
      state.si_pid != pid_) {
    return std::nullopt;
  }
  const int status = End();
  ForwardOutput();
  if (WIFEXITED(status)) {
    const int code = WEXITSTATUS(status);
    return Ending{code, 0, "exit code " + std::to_string(code)};
  }
  const int signal = WTERMSIG(status);
  return Ending{1, signal, "signal " + std::to_string(signal) + " (" + strsignal(signal) + ")"};
}

}  // namespace declutter::launcher
