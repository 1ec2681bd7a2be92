#include "launcher/log_tool/player.h"

#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>

#include "launcher/log_tool/log_scan.h"
#include "launcher/wire.h"

namespace declutter::log_tool {
namespace {

using Clock = std::chrono::steady_clock;

// Hears single keys of a terminal, and nothing where there is none.
class Keyboard {
 public:
  Keyboard() : is_terminal_(tcgetattr(STDIN_FILENO, &before_) == 0) {
    if (!is_terminal_) return;
    termios raw = before_;
    raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    tcsetattr(STDIN_FILENO, TCSANOW, &raw);
  }
  ~Keyboard() {
    if (is_terminal_) tcsetattr(STDIN_FILENO, TCSANOW, &before_);
  }
  Keyboard(const Keyboard&) = delete;
  Keyboard& operator=(const Keyboard&) = delete;

  // The key that comes within that time; 0 for none.
  char Wait(std::chrono::milliseconds limit) {
    pollfd waited = {is_terminal_ ? STDIN_FILENO : -1, POLLIN, 0};
    char key = 0;
    if (poll(&waited, 1, static_cast<int>(limit.count())) <= 0) return 0;
    return read(STDIN_FILENO, &key, 1) == 1 ? key : '\0';
  }

 private:
  termios before_ = {};
  bool is_terminal_;
};

// The time of the log, which runs at another speed and stands still when somebody wants it to.
class Pace {
 public:
  explicit Pace(double speed) : speed_(speed) {}

  void Restart() { start_ = Clock::now(); }

  // Returns when the event at at_s of the log is due.
  void Await(double at_s) {
    const auto after =
        std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(at_s / speed_));
    for (;;) {
      const Clock::time_point due = start_ + after;
      if (!is_stopped_ && Clock::now() >= due) return;
      const auto left =
          std::chrono::ceil<std::chrono::milliseconds>(std::max(due - Clock::now(), {}));
      constexpr std::chrono::milliseconds kLongest(1000);
      const char key = keyboard_.Wait(is_stopped_ ? kLongest : std::min(left, kLongest));
      if (key == 'n' && is_stopped_) {
        start_ = Clock::now() - after;  // goes on from here
        return;
      }
      if (key == ' ') Toggle();
    }
  }

 private:
  void Toggle() {
    if (is_stopped_) start_ += Clock::now() - stopped_;
    stopped_ = Clock::now();
    is_stopped_ = !is_stopped_;
  }

  double speed_;
  Keyboard keyboard_;
  Clock::time_point start_;
  Clock::time_point stopped_;
  bool is_stopped_ = false;
};

}  // namespace

bool Excerpt::Holds(const std::string& channel, int64_t utime, int64_t first_us) const {
  const double at_s = static_cast<double>(utime - first_us) * 1e-6;
  return at_s >= start_s && at_s <= end_s &&
         (channels.empty() || std::count(channels.begin(), channels.end(), channel) > 0);
}

int Play(const std::string& log, const Excerpt& excerpt, double speed, bool loops,
         const std::string& url) {
  launcher::Wire wire(url);
  Pace pace(speed);
  std::vector<std::string> damages;
  do {
    std::optional<int64_t> first_us;
    pace.Restart();
    damages = ForEachEvent(log, [&](const runtime::LogEvent& event) {
      if (!first_us) first_us = event.utime;
      if (!excerpt.Holds(event.channel, event.utime, *first_us)) return;
      pace.Await(static_cast<double>(event.utime - *first_us) * 1e-6 - excerpt.start_s);
      wire.Publish({event.channel, event.message});
    });
  } while (loops);
  for (const std::string& damage : damages) std::cerr << "log_tool: " << damage << "\n";
  return damages.empty() ? 0 : 1;
}

}  // namespace declutter::log_tool
