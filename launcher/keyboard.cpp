#include "launcher/keyboard.h"

#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace declutter::launcher {
namespace {

constexpr int kEndings[] = {SIGINT, SIGTERM};

termios g_before;  // for the handler, which can be given nothing

// To change the terminal from the background stops a program.
bool IsInForeground() { return tcgetpgrp(STDIN_FILENO) == getpgrp(); }

void Restore(int signal_number) {
  if (IsInForeground()) tcsetattr(STDIN_FILENO, TCSANOW, &g_before);
  signal(signal_number, SIG_DFL);
  raise(signal_number);
}

}  // namespace

Keyboard::Keyboard() {
  is_terminal_ = IsInForeground() && tcgetattr(STDIN_FILENO, &g_before) == 0;
  if (!is_terminal_) return;
  for (const int ending : kEndings) signal(ending, Restore);
  termios raw = g_before;
  raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  tcsetattr(STDIN_FILENO, TCSANOW, &raw);
}

Keyboard::~Keyboard() {
  if (!is_terminal_) return;
  if (IsInForeground()) tcsetattr(STDIN_FILENO, TCSANOW, &g_before);
  for (const int ending : kEndings) signal(ending, SIG_DFL);
}

char Keyboard::Wait(double limit_s) {
  constexpr double kLongest_s = 3600.0;
  pollfd waited = {is_terminal_ && IsInForeground() ? STDIN_FILENO : -1, POLLIN, 0};
  const double limit_ms = std::ceil(1e3 * std::clamp(limit_s, 0.0, kLongest_s));
  if (poll(&waited, 1, static_cast<int>(limit_ms)) <= 0) return 0;
  char key = 0;
  if (read(STDIN_FILENO, &key, 1) == 1) return key;
  is_terminal_ = false;  // it has been closed
  return 0;
}

}  // namespace declutter::launcher
