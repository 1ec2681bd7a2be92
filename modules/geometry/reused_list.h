#pragma once

#include <cstddef>
#include <vector>

namespace declutter {

// A list whose elements outlive Clear(), to be used again with the memory that they hold.
template <typename T>
class ReusedList {
 public:
  void Clear() { size_ = 0; }
  // Appends an element, which still is what it was when last in use.
  T& Add() {
    if (size_ == elements_.size()) elements_.emplace_back();
    return elements_[size_++];
  }
  void RemoveLast() { --size_; }

  size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T& operator[](size_t i) { return elements_[i]; }
  const T& operator[](size_t i) const { return elements_[i]; }
  T* begin() { return elements_.data(); }
  T* end() { return begin() + size_; }
  const T* begin() const { return elements_.data(); }
  const T* end() const { return begin() + size_; }

 private:
  std::vector<T> elements_;  // of which size_ are in use
  size_t size_ = 0;
};

}  // namespace declutter
