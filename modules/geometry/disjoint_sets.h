#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace declutter {

// Disjoint sets of 0 .. size - 1; the root of a set is its smallest element. The memory is used
// again.
class DisjointSets {
 public:
  // Makes each of `size` elements a set of its own.
  void Reset(size_t size) {
    parent_.resize(size);
    for (size_t i = 0; i < size; ++i) parent_[i] = static_cast<int32_t>(i);
  }
  // Appends an element, a set of its own.
  size_t Add() {
    parent_.push_back(static_cast<int32_t>(parent_.size()));
    return parent_.size() - 1;
  }
  size_t Root(size_t element) {
    auto i = static_cast<int32_t>(element);
    while (Parent(i) != i) i = Parent(i) = Parent(Parent(i));
    return static_cast<size_t>(i);
  }
  void Join(size_t a, size_t b) {
    const size_t root_a = Root(a), root_b = Root(b);
    parent_[std::max(root_a, root_b)] = static_cast<int32_t>(std::min(root_a, root_b));
  }
  size_t size() const { return parent_.size(); }

 private:
  int32_t& Parent(int32_t i) { return parent_[static_cast<size_t>(i)]; }

  std::vector<int32_t> parent_;
};

}  // namespace declutter
