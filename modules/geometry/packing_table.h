#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace declutter {

// For every set of 8 lanes, a bit each, the lanes of the set and behind them the others, each in
// their order. Sets of the first 4 lanes have these in front.
inline constexpr std::array<std::array<uint8_t, 8>, 256> kPackedLanes = [] {
  std::array<std::array<uint8_t, 8>, 256> packed{};
  for (size_t set = 0; set < packed.size(); ++set) {
    size_t place = 0;
    for (size_t is_out = 0; is_out < 2; ++is_out) {
      for (size_t lane = 0; lane < 8; ++lane) {
        if (((set >> lane) & 1) != is_out) packed[set][place++] = static_cast<uint8_t>(lane);
      }
    }
  }
  return packed;
}();

}  // namespace declutter
