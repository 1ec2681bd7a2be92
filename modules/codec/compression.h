#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

// The general-purpose compressor (zstd) behind all arrays that are worth it.
namespace declutter::codec {

std::vector<uint8_t> Compress(const uint8_t* data, size_t size);

// Decompresses into out and returns the number of bytes written; nothing when data is damaged or
// holds more than capacity bytes. What data itself says of its size is not relied on.
std::optional<size_t> Decompress(const std::vector<uint8_t>& data, uint8_t* out, size_t capacity);

}  // namespace declutter::codec
