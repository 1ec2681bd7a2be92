#pragma once

#include <termios.h>

namespace declutter::launcher {

// Single keys of the terminal at stdin, as long as the program is in its foreground; nothing where
// there is none. The terminal is as before when it is gone, also when SIGINT or SIGTERM ends the
// program.
class Keyboard {
 public:
  Keyboard();
  ~Keyboard();
  Keyboard(const Keyboard&) = delete;
  Keyboard& operator=(const Keyboard&) = delete;

  // The key that comes within that time; 0 for none. Returns at once after a signal.
  char Wait(double limit_s);

 private:
  bool is_terminal_ = false;
};

}  // namespace declutter::launcher
