#pragma once

#include <sys/types.h>

namespace declutter::launcher {

// Ends what our children have started when we end without doing so, as by SIGKILL. The children
// themselves die with us anyway; what they have started would not. It is a process of its own that
// hears from a pipe which process groups there are, and ends them when the pipe does.
class OrphanGuard {
 public:
  // Call while this process has one thread, and before it holds what must be gone when it ends.
  // Throws std::runtime_error when no process can be made.
  OrphanGuard();
  ~OrphanGuard();
  OrphanGuard(const OrphanGuard&) = delete;
  OrphanGuard& operator=(const OrphanGuard&) = delete;

  // Where a process group enters itself, or is taken out.
  int fd() const { return fd_; }

  // May be called between fork and exec. group: its leader's number. fd -1: nobody guards it.
  static void Enter(int fd, pid_t group);

  // Call while the number still belongs to the group.
  static void Leave(int fd, pid_t group);

 private:
  int fd_ = -1;
  pid_t pid_ = -1;
};

}  // namespace declutter::launcher
