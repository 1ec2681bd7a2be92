#include "modules/codec/depth_compression.h"

#include <memory>

#include "modules/codec/compression.h"
#include "modules/codec/rvl.h"

namespace declutter::codec {
namespace {

// Not initialised: of the worst case's size, an image touches a fifth.
std::unique_ptr<uint8_t[]> MakeRvlBuffer(size_t num_counts) {
  return std::unique_ptr<uint8_t[]>(new uint8_t[MaxRvlBytes(num_counts)]);
}

}  // namespace

std::vector<uint8_t> CompressDepth(const std::vector<uint16_t>& counts) {
  const auto rvl = MakeRvlBuffer(counts.size());
  const size_t rvl_size = EncodeRvl(counts, rvl.get());
  return Compress(rvl.get(), rvl_size);
}

std::optional<std::vector<uint16_t>> DecompressDepth(const std::vector<uint8_t>& data,
                                                     size_t num_counts) {
  const auto rvl = MakeRvlBuffer(num_counts);
  const auto rvl_size = Decompress(data, rvl.get(), MaxRvlBytes(num_counts));
  if (!rvl_size) return std::nullopt;
  return DecodeRvl(rvl.get(), *rvl_size, num_counts);
}

}  // namespace declutter::codec
