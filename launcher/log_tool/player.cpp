#include "launcher/log_tool/player.h"

#include <algorithm>
#include <iostream>
#include <stdexcept>

#include "launcher/keyboard.h"
#include "launcher/log_pace.h"
#include "launcher/log_tool/log_scan.h"
#include "launcher/monotonic_time.h"
#include "launcher/wire.h"

namespace declutter::log_tool {
namespace {

using launcher::MonotonicSeconds;

// Returns when what lies at at_s is due; with false when it will not be.
bool Await(double at_s, launcher::Keyboard* keyboard, launcher::LogPace* pace,
           const std::function<bool(char key)>& goes_on) {
  constexpr double kLongest_s = 0.1;
  for (;;) {
    const double wait_s = pace->Wait(at_s, MonotonicSeconds());
    const char key = keyboard->Wait(std::min(wait_s, kLongest_s));
    if (key == ' ') pace->Toggle(MonotonicSeconds());
    if (key == 'n') pace->StepTo(at_s);
    if (!goes_on(key)) return false;
    if (pace->Wait(at_s, MonotonicSeconds()) <= 0.0) return true;
  }
}

}  // namespace

std::vector<std::string> PlayTo(
    const std::function<void(const runtime::LogEvent&, double at_s)>& take, const std::string& log,
    const launcher::Excerpt& excerpt, double speed, const std::function<bool(char key)>& goes_on) {
  launcher::Keyboard keyboard;
  launcher::LogPace pace(speed, MonotonicSeconds() - excerpt.start_s / speed);
  bool has_event = false;
  auto damages = ForEachEventWhile(log, [&](const runtime::LogEvent& event, double at_s) {
    if (!excerpt.Holds(event.channel, at_s)) return true;
    has_event = true;
    if (!Await(at_s, &keyboard, &pace, goes_on)) return false;
    take(event, at_s);
    return true;
  });
  if (!has_event) throw std::runtime_error(log + ": no message in that part");
  return damages;
}

int Play(const std::string& log, const launcher::Excerpt& excerpt, double speed, bool loops,
         const std::string& url) {
  launcher::Wire wire(url);
  const auto publish = [&wire](const runtime::LogEvent& event, double) {
    wire.Publish({event.channel, event.message});
  };
  std::vector<std::string> damages;
  do {
    damages = PlayTo(publish, log, excerpt, speed, [](char) { return true; });
  } while (loops);
  for (const std::string& damage : damages) std::cerr << "log_tool: " << damage << "\n";
  return damages.empty() ? 0 : 1;
}

}  // namespace declutter::log_tool
