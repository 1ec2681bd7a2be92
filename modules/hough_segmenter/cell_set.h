#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace declutter {

// A set of indices, as of the cells of one component.
class CellSet {
 public:
  // Empty, for indices below num.
  void Clear(size_t num) { words_.assign((num + 63) / 64, 0); }
  void Add(size_t i) { words_[i / 64] |= Bit(i); }
  bool Contains(size_t i) const { return (words_[i / 64] & Bit(i)) != 0; }

  bool Intersects(const CellSet& other) const {
    const size_t num = std::min(words_.size(), other.words_.size());
    for (size_t k = 0; k < num; ++k) {
      if ((words_[k] & other.words_[k]) != 0) return true;
    }
    return false;
  }

  template <typename Visit>
  void ForEach(Visit visit) const {
    ForEachBit([](size_t, uint64_t word) { return word; }, visit);
  }

  // Calls visit(i) for each index that is in both.
  template <typename Visit>
  void ForEachIn(const CellSet& other, Visit visit) const {
    ForEachBit([&](size_t k, uint64_t word) { return word & other.words_[k]; }, visit);
  }

 private:
  static uint64_t Bit(size_t i) { return uint64_t{1} << (i % 64); }

  template <typename WordOf, typename Visit>
  void ForEachBit(WordOf word_of, Visit visit) const {
    for (size_t k = 0; k < words_.size(); ++k) {
      for (uint64_t rest = word_of(k, words_[k]); rest != 0; rest &= rest - 1) {
        visit(64 * k + static_cast<size_t>(__builtin_ctzll(rest)));
      }
    }
  }

  std::vector<uint64_t> words_;
};

}  // namespace declutter
