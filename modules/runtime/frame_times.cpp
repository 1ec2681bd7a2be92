#include "modules/runtime/frame_times.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace declutter::runtime {
namespace {

// Of frames that others skip no end is ever heard.
constexpr std::size_t kMaxBegun = 256;
// A log is replayed without a status in between.
constexpr std::size_t kMaxEnded = 1024;

}  // namespace

void FrameTimes::Begin(std::int64_t utime, double now_ms) {
  const auto same = [utime](const Begun& begun) { return begun.utime == utime; };
  if (std::any_of(begun_.begin(), begun_.end(), same)) return;
  begun_.push_back({utime, now_ms});
  if (begun_.size() > kMaxBegun) begun_.pop_front();
}

void FrameTimes::End(std::int64_t utime, double now_ms) {
  const auto same = [utime](const Begun& begun) { return begun.utime == utime; };
  const auto found = std::find_if(begun_.begin(), begun_.end(), same);
  if (found == begun_.end()) return;
  latencies_ms_.push_back(now_ms - found->at_ms);
  begun_.erase(found);
  if (latencies_ms_.size() > kMaxEnded) latencies_ms_.pop_front();
}

FrameTimes::Latency FrameTimes::Take() {
  const std::deque<double> taken = std::exchange(latencies_ms_, {});
  std::vector<double> ascending(taken.begin(), taken.end());
  std::sort(ascending.begin(), ascending.end());
  if (ascending.empty()) return {};
  return {ascending[(ascending.size() - 1) / 2], ascending.back()};
}

}  // namespace declutter::runtime
