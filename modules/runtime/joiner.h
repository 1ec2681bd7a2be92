#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "modules/runtime/part.h"

namespace declutter::runtime {

// Brings the two messages of a frame together by their utime, where b was computed from a. The last
// parts of each side stay after their pair is made: one that is sent again makes its pair again.
class Joiner {
 public:
  enum class Side { kA, kB };

  // capacity: parts kept of each side.
  explicit Joiner(std::size_t capacity) : capacity_(capacity) {}

  // The pair that this part completes. An a whose content differs from the one kept under the same
  // utime is another frame (a source that was started again): the kept b is not its partner.
  std::optional<Parts> Put(Side side, std::int64_t utime, Part part);

  // Parts that had to go before a partner came.
  std::int64_t num_unpaired() const { return num_unpaired_; }

 private:
  struct Kept {
    std::int64_t utime;
    Part part;
    bool paired;
  };

  static std::deque<Kept>::iterator Find(std::deque<Kept>& kept, std::int64_t utime);

  std::size_t capacity_;
  std::deque<Kept> kept_a_;
  std::deque<Kept> kept_b_;
  std::int64_t num_unpaired_ = 0;
};

}  // namespace declutter::runtime
