#include "modules/codec/compression.h"

#include <zstd.h>

#include <memory>
#include <stdexcept>
#include <string>

namespace declutter::codec {
namespace {

// Of the fastest level. What it gets is coded already: a table of recent data that fits into the
// fastest cache finds nearly all that repeats, and shorter repetitions are not worth their search.
constexpr int kLevel = 1;
constexpr int kTableBits = 12;
constexpr int kMinMatchBytes = 7;

struct FreeContext {
  void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
  void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};

std::unique_ptr<ZSTD_CCtx, FreeContext> MakeContext() {
  std::unique_ptr<ZSTD_CCtx, FreeContext> context(ZSTD_createCCtx());
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, kLevel);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_hashLog, kTableBits);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_minMatch, kMinMatchBytes);
  return context;
}

}  // namespace

std::vector<uint8_t> Compress(const uint8_t* data, size_t size) {
  // Making a context takes longer than compressing a small image.
  thread_local const std::unique_ptr<ZSTD_CCtx, FreeContext> context = MakeContext();
  std::vector<uint8_t> compressed(ZSTD_compressBound(size));
  const size_t compressed_size =
      ZSTD_compress2(context.get(), compressed.data(), compressed.size(), data, size);
  if (ZSTD_isError(compressed_size)) {
    throw std::logic_error(std::string("zstd: ") + ZSTD_getErrorName(compressed_size));
  }
  compressed.resize(compressed_size);
  return compressed;
}

std::optional<size_t> Decompress(const std::vector<uint8_t>& data, uint8_t* out, size_t capacity) {
  thread_local const std::unique_ptr<ZSTD_DCtx, FreeContext> context(ZSTD_createDCtx());
  const size_t size = ZSTD_decompressDCtx(context.get(), out, capacity, data.data(), data.size());
  if (ZSTD_isError(size)) return std::nullopt;
  return size;
}

}  // namespace declutter::codec
