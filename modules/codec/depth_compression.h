#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace declutter::codec {

// Depth counts, RVL coded, then zstd; lossless.
std::vector<uint8_t> CompressDepth(const std::vector<uint16_t>& counts);

// The num_counts counts in data; nothing when data is not exactly that.
std::optional<std::vector<uint16_t>> DecompressDepth(const std::vector<uint8_t>& data,
                                                     size_t num_counts);

}  // namespace declutter::codec
