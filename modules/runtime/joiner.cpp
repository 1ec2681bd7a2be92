#include "modules/runtime/joiner.h"

#include <algorithm>
#include <utility>

namespace declutter::runtime {

std::deque<Joiner::Kept>::iterator Joiner::Find(std::deque<Kept>& kept, std::int64_t utime) {
  return std::find_if(kept.begin(), kept.end(),
                      [utime](const Kept& entry) { return entry.utime == utime; });
}

std::optional<Parts> Joiner::Put(Side side, std::int64_t utime, Part part) {
  auto& own = side == Side::kA ? kept_a_ : kept_b_;
  auto& other = side == Side::kA ? kept_b_ : kept_a_;
  if (const auto old = Find(own, utime); old != own.end()) {
    const bool is_other_frame = side == Side::kA && *old->part != *part;
    const auto stale = is_other_frame ? Find(other, utime) : other.end();
    if (stale != other.end()) other.erase(stale);
    own.erase(old);
  } else if (own.size() == capacity_) {
    if (!own.front().paired) ++num_unpaired_;
    own.pop_front();
  }
  const auto partner = Find(other, utime);
  const bool paired = partner != other.end();
  own.push_back({utime, part, paired});
  if (!paired) return std::nullopt;
  partner->paired = true;
  if (side == Side::kA) return Parts{std::move(part), partner->part};
  return Parts{partner->part, std::move(part)};
}

}  // namespace declutter::runtime
