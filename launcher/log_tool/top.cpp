#include "launcher/log_tool/top.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <iostream>
#include <stdexcept>

#include "launcher/keyboard.h"
#include "launcher/log_tool/channel_monitor.h"
#include "launcher/log_tool/player.h"
#include "launcher/monotonic_time.h"

namespace declutter::log_tool {
namespace {

constexpr double kTurn_s = 0.05;
constexpr double kRenewal_s = 1.0;

// The terminal, or a pipe that gets the last state only.
class Screen {
 public:
  explicit Screen(const std::string& channel) : is_terminal_(isatty(STDOUT_FILENO) != 0) {
    if (!channel.empty()) monitor_.Choose(channel);
  }

  ChannelMonitor* monitor() { return &monitor_; }

  // now_s is of the messages' clock. False when the user wants to leave.
  bool Turn(char key, double now_s) {
    if (key == 'q') return false;
    if (key == 'j') monitor_.Choose(1);
    if (key == 'k') monitor_.Choose(-1);
    const double clock_s = launcher::MonotonicSeconds();
    if (is_terminal_ && (key != 0 || clock_s - drawn_s_ >= kRenewal_s)) {
      drawn_s_ = clock_s;
      Draw(now_s);
    }
    return true;
  }

  void Finish(double now_s) const {
    if (is_terminal_) return;
    for (const std::string& line : monitor_.Lines(now_s)) std::cout << line << "\n";
    std::cout << std::flush;
  }

 private:
  void Draw(double now_s) const {
    winsize size = {};
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_row < 2) size = {24, 80, 0, 0};
    std::string text = "\x1b[H\x1b[J";  // to the upper left, and clear
    int num_lines = 0;
    for (const std::string& line : monitor_.Lines(now_s)) {
      if (++num_lines == size.ws_row) break;
      text += line.substr(0, size.ws_col) + "\r\n";
    }
    std::cout << text << std::flush;
  }

  bool is_terminal_;
  ChannelMonitor monitor_;
  double drawn_s_ = -kRenewal_s;
};

bool IsOver(const TopOptions& options, double begin_s) {
  return options.seconds > 0 && launcher::MonotonicSeconds() - begin_s >= options.seconds;
}

}  // namespace

int WatchNetwork(const std::string& url, const TopOptions& options) {
  launcher::Wire wire(url);
  wire.Subscribe(".*");
  launcher::Keyboard keyboard;
  Screen screen(options.channel);
  const double begin_s = launcher::MonotonicSeconds();
  for (;;) {
    const char key = keyboard.Wait(kTurn_s);
    const double now_s = launcher::MonotonicSeconds();
    for (const launcher::Message& message : wire.Receive()) screen.monitor()->Add(message, now_s);
    if (!screen.Turn(key, now_s) || IsOver(options, begin_s)) {
      screen.Finish(now_s);
      return 0;
    }
  }
}

int WatchLog(const std::string& log, const TopOptions& options) {
  Screen screen(options.channel);
  const double begin_s = launcher::MonotonicSeconds();
  double now_s = 0.0;
  const auto damages = PlayTo(
      [&](const runtime::LogEvent& event, double at_s) {
        now_s = at_s;
        screen.monitor()->Add({event.channel, event.message}, at_s);
      },
      log, options.excerpt, options.speed,
      [&](char key) { return screen.Turn(key, now_s) && !IsOver(options, begin_s); });
  screen.Finish(now_s);
  for (const std::string& damage : damages) std::cerr << "log_tool: " << damage << "\n";
  return damages.empty() ? 0 : 1;
}

}  // namespace declutter::log_tool
