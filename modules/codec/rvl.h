#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

// Run-length variable-length coding of depth counts (Wilson, Fast Lossless Depth Image Compression,
// ISS 2017): runs of zero and nonzero counts in turn, their lengths and the differences of
// successive nonzero counts as groups of three bits, a fourth bit saying that more follow.
namespace declutter::codec {

// Size [byte] that EncodeRvl never exceeds.
size_t MaxRvlBytes(size_t num_counts);

// Writes counts to out, MaxRvlBytes(counts.size()) long, and returns the number of bytes written.
size_t EncodeRvl(const std::vector<uint16_t>& counts, uint8_t* out);

// The num_counts counts that EncodeRvl wrote as size bytes; nothing when data is anything else.
std::optional<std::vector<uint16_t>> DecodeRvl(const uint8_t* data, size_t size, size_t num_counts);

}  // namespace declutter::codec
