#pragma once

#include <chrono>

namespace declutter::launcher {

inline double MonotonicSeconds() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

}  // namespace declutter::launcher
