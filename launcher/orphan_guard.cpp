#include "launcher/orphan_guard.h"

#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <set>
#include <stdexcept>
#include <string>

namespace declutter::launcher {
namespace {

// Smaller than what a pipe takes at once: writers do not mix.
void Write(int fd, pid_t number) {
  if (fd >= 0 && write(fd, &number, sizeof(number)) < 0) return;  // the guard was killed
}

[[noreturn]] void Guard(int fd) {
  setsid();
  prctl(PR_SET_NAME, "launcher-guard");
  sigset_t all;
  sigfillset(&all);
  sigprocmask(SIG_BLOCK, &all, nullptr);
  std::set<pid_t> groups;
  pid_t number = 0;
  for (;;) {
    const ssize_t num_read = read(fd, &number, sizeof(number));
    if (num_read < 0 && errno == EINTR) continue;
    if (num_read != sizeof(number)) break;
    if (number > 0) {
      groups.insert(number);
    } else {
      groups.erase(-number);
    }
  }
  for (const pid_t group : groups) kill(-group, SIGKILL);
  _exit(0);
}

}  // namespace

OrphanGuard::OrphanGuard() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error(strerror(errno));
  pid_ = fork();
  if (pid_ == 0) {
    close(ends[1]);
    Guard(ends[0]);
  }
  close(ends[0]);
  fd_ = ends[1];
  if (pid_ > 0) return;
  close(fd_);
  throw std::runtime_error(std::string("fork: ") + strerror(errno));
}

OrphanGuard::~OrphanGuard() {
  close(fd_);
  waitpid(pid_, nullptr, 0);
}

void OrphanGuard::Enter(int fd, pid_t group) { Write(fd, group); }

void OrphanGuard::Leave(int fd, pid_t group) { Write(fd, -group); }

}  // namespace declutter::launcher
