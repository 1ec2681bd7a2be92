#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "modules/hough_segmenter/point_kernels.h"

namespace declutter {

// Points of the xy plane of T [m], each coordinate in an array of its own that kernels may read
// blocks of. Memory is used again.
class PlanarPoints {
 public:
  PlanarPoints() = default;
  PlanarPoints(PlanarPoints&&) = default;
  PlanarPoints& operator=(PlanarPoints&&) = default;
  PlanarPoints(const PlanarPoints& other) { Append(other); }
  PlanarPoints& operator=(const PlanarPoints& other) {
    Clear();
    Append(other);
    return *this;
  }

  void Clear() { num_ = 0; }
  void Add(const Eigen::Vector2f& p) {
    if (num_ + kCellBlock >= x_.size()) Grow();
    x_[num_] = p.x();
    y_[num_++] = p.y();
  }
  void Append(const PlanarPoints& other) {
    while (num_ + other.num_ + kCellBlock > x_.size()) Grow();
    std::copy_n(other.x(), other.num_, x_.begin() + static_cast<std::ptrdiff_t>(num_));
    std::copy_n(other.y(), other.num_, y_.begin() + static_cast<std::ptrdiff_t>(num_));
    num_ += other.num_;
  }

  size_t size() const { return num_; }
  bool empty() const { return num_ == 0; }
  const float* x() const { return x_.data(); }
  const float* y() const { return y_.data(); }
  Eigen::Vector2f operator[](size_t i) const { return {x_[i], y_[i]}; }

 private:
  void Grow() {
    const size_t size = std::max(size_t{256}, 2 * x_.size());
    x_.resize(size);
    y_.resize(size);
  }

  size_t num_ = 0;
  std::vector<float> x_, y_;
};

}  // namespace declutter
