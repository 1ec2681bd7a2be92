#include "launcher/log_tool/player.h"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <stdexcept>
#include <vector>

#include "launcher/keyboard.h"
#include "launcher/log_pace.h"
#include "launcher/log_tool/log_scan.h"
#include "launcher/wire.h"

namespace declutter::log_tool {
namespace {

double Now_s() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

// Returns when what lies at at_s is due.
void Await(double at_s, launcher::Keyboard* keyboard, launcher::LogPace* pace) {
  constexpr double kLongest_s = 1.0;
  for (;;) {
    const double wait_s = pace->Wait(at_s, Now_s());
    if (wait_s <= 0.0) return;
    const char key = keyboard->Wait(std::min(wait_s, kLongest_s));
    if (key == ' ') pace->Toggle(Now_s());
    if (key == 'n') pace->StepTo(at_s);
  }
}

}  // namespace

std::vector<std::string> PlayTo(const std::function<void(const runtime::LogEvent&)>& take,
                                const std::string& log, const launcher::Excerpt& excerpt,
                                double speed) {
  launcher::Keyboard keyboard;
  launcher::LogPace pace(speed, Now_s() - excerpt.start_s / speed);
  return ForEachEvent(log, [&](const runtime::LogEvent& event, double at_s) {
    if (!excerpt.Holds(event.channel, at_s)) return;
    Await(at_s, &keyboard, &pace);
    take(event);
  });
}

int Play(const std::string& log, const launcher::Excerpt& excerpt, double speed, bool loops,
         const std::string& url) {
  launcher::Wire wire(url);
  int64_t num_published = 0;
  const auto publish = [&](const runtime::LogEvent& event) {
    wire.Publish({event.channel, event.message});
    ++num_published;
  };
  std::vector<std::string> damages;
  do {
    damages = PlayTo(publish, log, excerpt, speed);
    if (num_published == 0) throw std::runtime_error(log + ": no message in that part");
  } while (loops);
  for (const std::string& damage : damages) std::cerr << "log_tool: " << damage << "\n";
  return damages.empty() ? 0 : 1;
}

}  // namespace declutter::log_tool
