#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "modules/geometry/marked_pixels.h"

namespace declutter {

// Bits of a pixel that a run of its row begins or ends with.
inline constexpr uint8_t kRunBegins = 1, kRunEnds = 2;

// The bits of a marked pixel, which is_joined with the one before and is_next_joined with the one
// after (1, else 0); 0 for others. Inlined, so that it is compiled for each processor.
inline __attribute__((always_inline)) uint8_t RunEdges(bool is_marked, uint8_t is_joined,
                                                       uint8_t is_next_joined) {
  const int begins = is_joined > 0 ? 0 : kRunBegins, ends = is_next_joined > 0 ? 0 : kRunEnds;
  return static_cast<uint8_t>(is_marked ? begins + ends : 0);
}

// Appends the runs of a row whose first pixel has the index `begin`, from the bits of its pixels.
template <typename Run>
void AppendRuns(const std::vector<uint8_t>& edges, size_t begin, std::vector<Run>* runs) {
  ForEachMarked(edges.data(), 0, edges.size(), [&](size_t i) {
    if ((edges[i] & kRunBegins) != 0) runs->push_back({begin + i, begin + i});
    if ((edges[i] & kRunEnds) != 0) runs->back().end = begin + i + 1;
  });
}

}  // namespace declutter
