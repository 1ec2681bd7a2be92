#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <cstdlib>
#include <functional>
#include <stdexcept>
#include <string>

namespace declutter {

// A terminal whose keys a test presses.
class Terminal {
 public:
  Terminal() : fd_(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
    if (fd_ < 0 || grantpt(fd_) != 0 || unlockpt(fd_) != 0) throw std::runtime_error("no terminal");
    name_ = ptsname(fd_);
  }
  ~Terminal() { close(fd_); }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  // To be called in a program under test: it reads from this terminal, in its foreground.
  std::function<void()> AsStdin() const {
    return [this] {
      setsid();
      const int end = open(name_.c_str(), O_RDWR);
      ioctl(end, TIOCSCTTY, 0);
      dup2(end, STDIN_FILENO);
    };
  }

  void Press(char key) const { EXPECT_EQ(write(fd_, &key, 1), 1); }

  // Whether it gives lines and shows what is typed.
  tcflag_t Mode() const {
    termios state = {};
    EXPECT_EQ(tcgetattr(fd_, &state), 0);
    return state.c_lflag;
  }

 private:
  int fd_;
  std::string name_;
};

}  // namespace declutter
