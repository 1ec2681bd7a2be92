#include "modules/codec/rvl.h"

#include <array>
#include <cstring>

namespace declutter::codec {
namespace {

// Nibbles are packed into 32-bit words, the first one highest.
constexpr int kWordBits = 32;
constexpr size_t kWordBytes = 4;
// One look into a table codes or decodes a chunk: up to three nibbles, nine bits of a value.
constexpr int kChunkNibbles = 3;
constexpr int kChunkValueBits = 3 * kChunkNibbles;
constexpr int kChunkCodeBits = 4 * kChunkNibbles;
constexpr uint32_t kChunkValues = 1u << kChunkValueBits;
// More than the longest run and the largest difference need.
constexpr int kMaxChunks = 3;

struct Code {
  uint16_t nibbles = 0;
  uint16_t num_bits = 0;
};

struct Chunk {
  uint16_t value = 0;
  uint8_t num_bits = 0;
  bool more = false;  // the value goes on in the next chunk
};

constexpr std::array<Code, kChunkValues> MakeCodes() {
  std::array<Code, kChunkValues> codes{};
  for (uint32_t value = 0; value < kChunkValues; ++value) {
    uint32_t nibbles = 0;
    int num_bits = 0;
    uint32_t rest = value;
    do {
      nibbles = (nibbles << 4) | (rest & 7u) | (rest > 7u ? 8u : 0u);
      num_bits += 4;
      rest >>= 3;
    } while (rest != 0);
    codes[value] = {static_cast<uint16_t>(nibbles), static_cast<uint16_t>(num_bits)};
  }
  return codes;
}

constexpr std::array<Chunk, 1u << kChunkCodeBits> MakeChunks() {
  std::array<Chunk, 1u << kChunkCodeBits> chunks{};
  for (uint32_t nibbles = 0; nibbles < chunks.size(); ++nibbles) {
    uint32_t value = 0;
    int num = 0;
    bool more = true;
    while (more && num < kChunkNibbles) {
      const uint32_t nibble = (nibbles >> (4 * (kChunkNibbles - 1 - num))) & 15u;
      value |= (nibble & 7u) << (3 * num);
      more = (nibble & 8u) != 0;
      ++num;
    }
    chunks[nibbles] = {static_cast<uint16_t>(value), static_cast<uint8_t>(4 * num), more};
  }
  return chunks;
}

constexpr std::array<Code, kChunkValues> kCodes = MakeCodes();
constexpr std::array<Chunk, 1u << kChunkCodeBits> kChunks = MakeChunks();

class NibbleWriter {
 public:
  explicit NibbleWriter(uint8_t* out) : begin_(out), next_(out) {}

  void Put(uint32_t value) {
    while (value >= kChunkValues) {
      const uint32_t chunk = value & (kChunkValues - 1);
      // All three nibbles say that more follow.
      const uint32_t nibbles = ((chunk & 7u) << 8) | ((chunk & 0x38u) << 1) | (chunk >> 6) | 0x888u;
      PutBits(nibbles, kChunkCodeBits);
      value >>= kChunkValueBits;
    }
    PutBits(kCodes[value].nibbles, kCodes[value].num_bits);
  }

  // Fills the last word with zeros; the number of bytes written.
  size_t Finish() {
    if (num_bits_ > 0) PutBits(0, kWordBits - num_bits_);
    return static_cast<size_t>(next_ - begin_);
  }

 private:
  void PutBits(uint32_t bits, int num_bits) {
    bits_ = (bits_ << num_bits) | bits;
    num_bits_ += num_bits;
    if (num_bits_ < kWordBits) return;
    num_bits_ -= kWordBits;
    const uint32_t word = static_cast<uint32_t>(bits_ >> num_bits_);
    std::memcpy(next_, &word, kWordBytes);
    next_ += kWordBytes;
  }

  uint8_t* const begin_;
  uint8_t* next_;
  uint64_t bits_ = 0;  // the lowest num_bits_ are not written yet
  int num_bits_ = 0;   // below kWordBits
};

// Reads zeros beyond the end and knows that it did.
class NibbleReader {
 public:
  NibbleReader(const uint8_t* data, size_t size) : next_(data), end_(data + size) {}

  uint32_t Get() {
    uint32_t value = 0;
    for (int i = 0; i < kMaxChunks; ++i) {
      Refill();
      const Chunk chunk = kChunks[bits_ >> (64 - kChunkCodeBits)];
      bits_ <<= chunk.num_bits;
      num_bits_ -= chunk.num_bits;
      value |= static_cast<uint32_t>(chunk.value) << (i * kChunkValueBits);
      if (!chunk.more) return value;
    }
    overlong_ = true;
    return value;
  }

  bool ok() const { return !overlong_ && num_bits_ >= num_missing_bits_; }
  // Only the filling of the last word is left.
  bool AtEnd() const {
    return ok() && next_ == end_ && bits_ == 0 && num_bits_ - num_missing_bits_ < kWordBits;
  }

 private:
  void Refill() {
    if (num_bits_ >= kChunkCodeBits) return;
    uint32_t word = 0;
    if (next_ < end_) {
      std::memcpy(&word, next_, kWordBytes);
      next_ += kWordBytes;
    } else {
      num_missing_bits_ += kWordBits;
    }
    bits_ |= static_cast<uint64_t>(word) << (kWordBits - num_bits_);
    num_bits_ += kWordBits;
  }

  const uint8_t* next_;
  const uint8_t* const end_;
  uint64_t bits_ = 0;  // the highest num_bits_ are not read yet, the others are zero
  int64_t num_bits_ = 0;
  int64_t num_missing_bits_ = 0;  // of those in bits_ and before, how many lie beyond the end
  bool overlong_ = false;
};

size_t EndOfRun(const std::vector<uint16_t>& counts, size_t begin, bool zero) {
  size_t end = begin;
  while (end < counts.size() && (counts[end] == 0) == zero) ++end;
  return end;
}

}  // namespace

size_t MaxRvlBytes(size_t num_counts) {
  // Six nibbles for a difference, which also covers a pair of lengths for every two counts; two
  // lengths and a word more for the ends.
  return 3 * num_counts + 6 * kWordBytes;
}

size_t EncodeRvl(const std::vector<uint16_t>& counts, uint8_t* out) {
  NibbleWriter writer(out);
  int32_t previous = 0;
  for (size_t i = 0; i < counts.size();) {
    const size_t begin = EndOfRun(counts, i, true);
    const size_t end = EndOfRun(counts, begin, false);
    writer.Put(static_cast<uint32_t>(begin - i));
    writer.Put(static_cast<uint32_t>(end - begin));
    for (i = begin; i < end; ++i) {
      const int32_t difference = counts[i] - previous;
      previous = counts[i];
      // Small differences of either sign become small numbers.
      writer.Put((static_cast<uint32_t>(difference) << 1) ^
                 static_cast<uint32_t>(difference >> 31));
    }
  }
  return writer.Finish();
}

std::optional<std::vector<uint16_t>> DecodeRvl(const uint8_t* data, size_t size,
                                               size_t num_counts) {
  if (size % kWordBytes != 0) return std::nullopt;
  std::vector<uint16_t> counts(num_counts);
  NibbleReader reader(data, size);
  uint32_t previous = 0;
  bool in_range = true;
  for (size_t i = 0; i < num_counts;) {
    const size_t num_zero = reader.Get();
    const size_t num_nonzero = reader.Get();
    const bool progress = num_zero + num_nonzero > 0;
    if (!progress || !reader.ok() || num_zero + num_nonzero > num_counts - i) return std::nullopt;
    i += num_zero;
    for (const size_t end = i + num_nonzero; i < end; ++i) {
      const uint32_t code = reader.Get();
      previous += (code >> 1) ^ (0u - (code & 1u));
      in_range &= previous - 1 < 0xFFFFu;
      counts[i] = static_cast<uint16_t>(previous);
    }
    if (!in_range) return std::nullopt;
  }
  if (!reader.AtEnd()) return std::nullopt;
  return counts;
}

}  // namespace declutter::codec
