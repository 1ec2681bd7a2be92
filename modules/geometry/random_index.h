#pragma once

#include <cstddef>
#include <cstdint>

namespace declutter {

// A cheap stream of random indices (SplitMix64 by Steele, Lea and Flood, 2014): the same on every
// machine, and without the divisions of a standard distribution, where samples are drawn by the
// hundred thousand.
class RandomIndex {
 public:
  explicit RandomIndex(uint64_t seed) : state_(seed) {}

  // In [0, num), num > 0 and below 2^32.
  size_t operator()(size_t num) { return Scaled(Bits(), num); }

  // The random bits of an index, and the index in [0, num) that they stand for.
  uint32_t Bits() {
    state_ += kStep;
    uint64_t x = state_;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
    return static_cast<uint32_t>((x ^ (x >> 31)) >> 32);
  }
  static size_t Scaled(uint32_t bits, size_t num) {
    return static_cast<size_t>(uint64_t{bits} * num >> 32);
  }

  // Leaves out the next num indices.
  void Skip(size_t num) { state_ += num * kStep; }

 private:
  static constexpr uint64_t kStep = 0x9E3779B97F4A7C15ull;

  uint64_t state_;
};

}  // namespace declutter
