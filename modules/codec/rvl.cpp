#include "modules/codec/rvl.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "modules/geometry/for_each_processor.h"

namespace declutter::codec {
namespace {

// Nibbles are packed into 32-bit words, the first one highest.
constexpr uint32_t kWordBits = 32;
constexpr size_t kWordBytes = 4;
// One look into a table codes or decodes a chunk: up to three nibbles, nine bits of a value.
constexpr int kChunkNibbles = 3;
constexpr int kChunkValueBits = 3 * kChunkNibbles;
constexpr uint32_t kChunkCodeBits = 4 * kChunkNibbles;
constexpr uint32_t kChunkValues = 1u << kChunkValueBits;
// More than the longest run and the largest difference need.
constexpr int kMaxNibbles = 9;

struct Code {
  uint16_t nibbles = 0;
  uint16_t num_bits = 0;
};

// The differences that a chunk holds as a whole, from its first nibble on.
struct Chunk {
  std::array<int16_t, kChunkNibbles> differences{};  // 0 beyond num
  uint8_t num = 0;
  uint8_t num_bits = 0;  // of all of them
};

// Small differences of either sign become small numbers.
constexpr uint32_t ToNumber(int32_t difference) {
  return (static_cast<uint32_t>(difference) << 1) ^ static_cast<uint32_t>(difference >> 31);
}
constexpr uint32_t ToDifference(uint32_t number) { return (number >> 1) ^ (0u - (number & 1u)); }

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

constexpr Chunk MakeChunk(uint32_t nibbles) {
  Chunk chunk;
  uint32_t number = 0;
  int num_bits = 0;  // of the number so far
  for (int i = 0; i < kChunkNibbles; ++i) {
    const uint32_t nibble = (nibbles >> (4 * (kChunkNibbles - 1 - i))) & 15u;
    number |= (nibble & 7u) << num_bits;
    num_bits += 3;
    if ((nibble & 8u) != 0) continue;
    chunk.differences[chunk.num++] = static_cast<int16_t>(ToDifference(number));
    chunk.num_bits = static_cast<uint8_t>(4 * (i + 1));
    number = 0;
    num_bits = 0;
  }
  return chunk;
}

constexpr std::array<Chunk, 1u << kChunkCodeBits> MakeChunks() {
  std::array<Chunk, 1u << kChunkCodeBits> chunks{};
  for (uint32_t nibbles = 0; nibbles < chunks.size(); ++nibbles) {
    chunks[nibbles] = MakeChunk(nibbles);
  }
  return chunks;
}

constexpr std::array<Code, kChunkValues> kCodes = MakeCodes();
constexpr std::array<Chunk, 1u << kChunkCodeBits> kChunks = MakeChunks();

class NibbleWriter {
 public:
  explicit NibbleWriter(uint8_t* out) : begin_(out), next_(out) {}

  void Put(uint32_t number) {
    while (number >= kChunkValues) {
      const uint32_t chunk = number & (kChunkValues - 1);
      // All three nibbles say that more follow.
      const uint32_t nibbles = ((chunk & 7u) << 8) | ((chunk & 0x38u) << 1) | (chunk >> 6) | 0x888u;
      PutBits(nibbles, kChunkCodeBits);
      number >>= kChunkValueBits;
    }
    PutBits(kCodes[number].nibbles, kCodes[number].num_bits);
  }

  void PutTwo(uint32_t first, uint32_t second) {
    if ((first | second) >= kChunkValues) {
      Put(first);
      Put(second);
      return;
    }
    const Code a = kCodes[first], b = kCodes[second];
    PutBits((uint32_t{a.nibbles} << b.num_bits) | b.nibbles, uint32_t{a.num_bits} + b.num_bits);
  }

  // Fills the last word with zeros; the number of bytes written.
  size_t Finish() {
    if (num_bits_ > 0) PutBits(0, kWordBits - num_bits_);
    return static_cast<size_t>(next_ - begin_);
  }

 private:
  // Always writes a word, which the next one replaces until it is full: a branch that depends on
  // the data takes longer.
  void PutBits(uint32_t bits, uint32_t num_bits) {
    bits_ = (bits_ << num_bits) | bits;
    num_bits_ += num_bits;
    const auto word = static_cast<uint32_t>(bits_ >> ((num_bits_ - kWordBits) % 64));
    std::memcpy(next_, &word, kWordBytes);
    next_ += num_bits_ / kWordBits * kWordBytes;
    num_bits_ %= kWordBits;
  }

  uint8_t* const begin_;
  uint8_t* next_;
  uint64_t bits_ = 0;      // the lowest num_bits_ are not written yet
  uint32_t num_bits_ = 0;  // below kWordBits
};

// Reads zeros beyond the end and knows that it did.
class NibbleReader {
 public:
  NibbleReader(const uint8_t* data, size_t size) : next_(data), end_(data + size) {}

  uint32_t Get() {
    Refill();
    uint32_t number = 0;
    for (int i = 0; i < kMaxNibbles; ++i) {
      if (i == kMaxNibbles - 1) Refill();
      const auto nibble = static_cast<uint32_t>(bits_ >> 60);
      Skip(4);
      number |= (nibble & 7u) << (3 * i);
      if ((nibble & 8u) == 0) return number;
    }
    overlong_ = true;
    return number;
  }

  // The differences that come whole in the next chunk; none: Get() reads the next one. Refill()
  // lasts for two chunks.
  const Chunk& Peek() const { return kChunks[bits_ >> (64 - kChunkCodeBits)]; }
  void Skip(uint32_t num_bits) {
    bits_ <<= num_bits;
    num_bits_ -= num_bits;
  }

  // To a word at least. The next word is always read, and taken where there is room: a branch that
  // depends on the data takes longer.
  void Refill() {
    const uint64_t takes = num_bits_ < kWordBits;
    if (next_ == end_) {
      num_bits_ += takes * kWordBits;
      num_missing_bits_ += takes * kWordBits;
      return;
    }
    uint32_t word;
    std::memcpy(&word, next_, kWordBytes);
    bits_ |= (static_cast<uint64_t>(word) << ((kWordBits - num_bits_) % 64)) & (0u - takes);
    num_bits_ += takes * kWordBits;
    next_ += takes * kWordBytes;
  }

  bool ok() const { return !overlong_ && num_bits_ >= num_missing_bits_; }
  // Only the filling of the last word is left.
  bool AtEnd() const {
    return ok() && next_ == end_ && bits_ == 0 && num_bits_ - num_missing_bits_ < kWordBits;
  }

 private:
  const uint8_t* next_;
  const uint8_t* const end_;
  uint64_t bits_ = 0;  // the highest num_bits_ are not read yet, the others are zero
  uint64_t num_bits_ = 0;
  uint64_t num_missing_bits_ = 0;  // of those in bits_ and before, how many lie beyond the end
  bool overlong_ = false;
};

// Four counts at a time.
size_t EndOfZeros(const std::vector<uint16_t>& counts, size_t begin) {
  for (uint64_t four = 0; begin + 4 <= counts.size(); begin += 4) {
    std::memcpy(&four, &counts[begin], sizeof four);
    if (four != 0) break;
  }
  while (begin < counts.size() && counts[begin] == 0) ++begin;
  return begin;
}

size_t EndOfNonzeros(const std::vector<uint16_t>& counts, size_t begin) {
  constexpr uint64_t kOnes = 0x0001000100010001, kHighest = 0x8000800080008000;
  for (uint64_t four = 0; begin + 4 <= counts.size(); begin += 4) {
    std::memcpy(&four, &counts[begin], sizeof four);
    // Only where one of them is 0 does the lowest such one borrow into its highest bit.
    if (((four - kOnes) & ~four & kHighest) != 0) break;
  }
  while (begin < counts.size() && counts[begin] != 0) ++begin;
  return begin;
}

// Counts coded together.
constexpr size_t kBlock = 256;

DECLUTTER_FOR_EACH_PROCESSOR void ToNumbers(const uint16_t* counts, size_t num, int32_t previous,
                                            uint32_t* numbers) {
  numbers[0] = ToNumber(counts[0] - previous);
  for (size_t i = 1; i < num; ++i) numbers[i] = ToNumber(counts[i] - counts[i - 1]);
}

// Reads num counts that are not 0; false when they leave the range of counts.
bool ReadRun(size_t num, NibbleReader* reader, uint32_t* previous, uint16_t* counts) {
  uint32_t count = *previous;
  uint32_t bits = 0;  // of all counts, and of all counts - 1: 32 where one is 0
  const auto add = [&](uint32_t difference, size_t i) {
    count += difference;
    bits |= count | (count - 1);
    counts[i] = static_cast<uint16_t>(count);
  };
  size_t i = 0;
  // Adds also those beyond chunk.num, which change nothing and are written again.
  const auto add_chunk = [&] {
    const Chunk& chunk = reader->Peek();
    if (chunk.num == 0) return false;
    reader->Skip(chunk.num_bits);
    for (size_t k = 0; k < kChunkNibbles; ++k) {
      add(static_cast<uint32_t>(int32_t{chunk.differences[k]}), i + k);
    }
    i += chunk.num;
    return true;
  };
  while (i + 2 * kChunkNibbles <= num) {
    reader->Refill();
    if (!(add_chunk() && add_chunk())) add(ToDifference(reader->Get()), i++);
  }
  while (i < num) add(ToDifference(reader->Get()), i++);
  *previous = count;
  return bits < 1u << 16;
}

}  // namespace

size_t MaxRvlBytes(size_t num_counts) {
  // Six nibbles for a difference, which also covers a pair of lengths for every two counts; two
  // lengths and two words more for the ends, one of them written ahead.
  return 3 * num_counts + 6 * kWordBytes;
}

size_t EncodeRvl(const std::vector<uint16_t>& counts, uint8_t* out) {
  NibbleWriter writer(out);
  std::array<uint32_t, kBlock> numbers;
  int32_t previous = 0;
  for (size_t i = 0; i < counts.size();) {
    const size_t begin = EndOfZeros(counts, i);
    const size_t end = EndOfNonzeros(counts, begin);
    writer.Put(static_cast<uint32_t>(begin - i));
    writer.Put(static_cast<uint32_t>(end - begin));
    for (i = begin; i < end; i += kBlock) {
      const size_t num = std::min(kBlock, end - i);
      ToNumbers(&counts[i], num, previous, numbers.data());
      for (size_t k = 0; k + 1 < num; k += 2) writer.PutTwo(numbers[k], numbers[k + 1]);
      if (num % 2 == 1) writer.Put(numbers[num - 1]);
      previous = counts[i + num - 1];
    }
    i = end;
  }
  return writer.Finish();
}

std::optional<std::vector<uint16_t>> DecodeRvl(const uint8_t* data, size_t size,
                                               size_t num_counts) {
  if (size % kWordBytes != 0) return std::nullopt;
  std::vector<uint16_t> counts(num_counts);
  NibbleReader reader(data, size);
  uint32_t previous = 0;
  for (size_t i = 0; i < num_counts;) {
    const size_t num_zero = reader.Get();
    const size_t num_nonzero = reader.Get();
    const bool progress = num_zero + num_nonzero > 0;
    if (!progress || !reader.ok() || num_zero + num_nonzero > num_counts - i) return std::nullopt;
    i += num_zero;
    if (!ReadRun(num_nonzero, &reader, &previous, counts.data() + i)) return std::nullopt;
    i += num_nonzero;
  }
  if (!reader.AtEnd()) return std::nullopt;
  return counts;
}

}  // namespace declutter::codec
