#include "modules/runtime/journal.h"

#include <chrono>
#include <cstdio>

namespace declutter::runtime {

std::optional<int> LineLimiter::Admit(const std::string& cause, double now_s) {
  const auto [entry, is_new] = causes_.try_emplace(cause, Cause{now_s, 0});
  if (is_new) return 0;
  if (now_s - entry->second.last_s < 1.0) {
    ++entry->second.num_held_back;
    return std::nullopt;
  }
  const int num_held_back = entry->second.num_held_back;
  entry->second = {now_s, 0};
  return num_held_back;
}

void Journal::Write(const std::string& cause, const std::string& text) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  const auto num_held_back = limiter_.Admit(cause, std::chrono::duration<double>(now).count());
  if (!num_held_back) return;
  std::string line = name_ + ": " + text;
  if (*num_held_back > 0) line += " [" + std::to_string(*num_held_back) + " more]";
  std::fprintf(stderr, "%s\n", line.c_str());
}

}  // namespace declutter::runtime
