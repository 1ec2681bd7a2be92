#include "launcher/program_output.h"

#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <stdexcept>
#include <thread>

namespace declutter::launcher {
namespace {

// A file without a name: unlike a pipe it never makes the writer wait.
class Sheet {
 public:
  Sheet() : fd_(memfd_create("output", MFD_CLOEXEC)) {
    if (fd_ < 0) throw std::runtime_error(std::string("memfd_create: ") + strerror(errno));
  }
  ~Sheet() { close(fd_); }
  Sheet(const Sheet&) = delete;
  Sheet& operator=(const Sheet&) = delete;

  int fd() const { return fd_; }

  std::string Read() const {
    std::string text(static_cast<size_t>(lseek(fd_, 0, SEEK_END)), '\0');
    const ssize_t size = pread(fd_, text.data(), text.size(), 0);
    text.resize(size < 0 ? 0 : static_cast<size_t>(size));
    return text;
  }

 private:
  int fd_;
};

std::string LastLine(std::string text) {
  text.erase(text.find_last_not_of('\n') + 1);
  return text.substr(text.rfind('\n') + 1);
}

// False when the process still runs at the time limit.
bool EndsWithin(pid_t pid, double limit_s) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(limit_s);
  for (;;) {
    siginfo_t state = {};
    waitid(P_PID, static_cast<id_t>(pid), &state, WEXITED | WNOHANG | WNOWAIT);
    if (state.si_pid == pid) return true;
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

// Ends it and what it has started; returns the status of waitpid.
int End(pid_t pid) {
  kill(-pid, SIGKILL);  // while it is unreaped its number belongs to its group
  kill(pid, SIGKILL);   // had it no group yet
  int status = 0;
  waitpid(pid, &status, 0);
  return status;
}

}  // namespace

ProgramOutput RunProgram(const std::vector<std::string>& command, double limit_s) {
  const Sheet out, err;
  std::vector<char*> argv;
  for (const std::string& word : command) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid < 0) throw std::runtime_error(std::string("fork: ") + strerror(errno));
  if (pid == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(127);  // it died before the line above
    setpgid(0, 0);
    dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
    dup2(out.fd(), STDOUT_FILENO);
    dup2(err.fd(), STDERR_FILENO);
    execv(argv[0], argv.data());
    _exit(127);
  }
  const bool is_in_time = EndsWithin(pid, limit_s);
  const int status = End(pid);
  if (!is_in_time) return {1, "no answer in time", "", LastLine(err.Read())};
  if (WIFSIGNALED(status)) return {1, strsignal(WTERMSIG(status)), "", LastLine(err.Read())};
  const int code = WEXITSTATUS(status);
  return {code, "exit code " + std::to_string(code), out.Read(), LastLine(err.Read())};
}

}  // namespace declutter::launcher
