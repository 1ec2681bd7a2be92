#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace declutter {

// Calls visit(i) for every i of [begin, end) where mask[i] is not 0, in order. Most are 0 in most
// masks: eight are skipped at once.
template <typename Visit>
void ForEachMarked(const uint8_t* mask, size_t begin, size_t end, Visit visit) {
  size_t i = begin;
  while (i < end) {
    uint64_t eight = 0;
    if (end - i >= sizeof eight) {
      std::memcpy(&eight, mask + i, sizeof eight);
      if (eight == 0) {
        i += sizeof eight;
        continue;
      }
    }
    const size_t last = end - i >= sizeof eight ? i + sizeof eight : end;
    for (; i < last; ++i) {
      if (mask[i] != 0) visit(i);
    }
  }
}

}  // namespace declutter
