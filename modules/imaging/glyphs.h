#pragma once

#include <array>
#include <cstdint>

namespace declutter::imaging {

inline constexpr int kGlyphWidth = 5;
inline constexpr int kGlyphHeight = 7;

// The rows of a character from the top; bit 4 of a row is its left dot. Small letters have the
// shape of capitals, unknown characters that of an empty box.
const std::array<uint8_t, kGlyphHeight>& GlyphOf(char character);

}  // namespace declutter::imaging
