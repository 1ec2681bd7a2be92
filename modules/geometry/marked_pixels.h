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
  for (uint64_t eight = 0; i + sizeof eight <= end; i += sizeof eight) {
    std::memcpy(&eight, mask + i, sizeof eight);
    while (eight != 0) {
      // Of the first marked byte: it is the lowest of a word on all machines that this runs on.
      const int bit = __builtin_ctzll(eight) & ~7;
      visit(i + static_cast<size_t>(bit) / 8);
      eight &= ~(uint64_t{0xFF} << bit);
    }
  }
  for (; i < end; ++i) {
    if (mask[i] != 0) visit(i);
  }
}

}  // namespace declutter
