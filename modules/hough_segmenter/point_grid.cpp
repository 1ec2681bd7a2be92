#include "modules/hough_segmenter/point_grid.h"

#include <algorithm>

namespace declutter {

void PointGrid::Sort() {
  low_.setZero();
  if (!points_.empty()) low_ = points_[0].p_T.head<2>();
  Eigen::Vector2f high = low_;
  max_sigma_ = 0;
  for (const SurfacePoint& point : points_) {
    low_ = low_.cwiseMin(point.p_T.head<2>());
    high = high.cwiseMax(point.p_T.head<2>());
    max_sigma_ = std::max(max_sigma_, point.sigma);
  }
  num_columns_ = static_cast<int>((high.x() - low_.x()) / kSide) + 1;
  num_rows_ = static_cast<int>((high.y() - low_.y()) / kSide) + 1;
  // begin_[s + 2] counts, then begins, and at last begin_[s + 1] ends the points of square s.
  begin_.assign(static_cast<size_t>(num_columns_ * num_rows_) + 2, 0);
  square_.resize(points_.size());
  for (size_t k = 0; k < points_.size(); ++k) {
    const Eigen::Vector2i square = SquareOf(points_[k].p_T.head<2>());
    square_[k] = static_cast<uint32_t>(square.y() * num_columns_ + square.x());
    ++begin_[square_[k] + 2];
  }
  for (size_t s = 2; s < begin_.size(); ++s) begin_[s] += begin_[s - 1];
  sorted_.resize(points_.size());
  for (size_t k = 0; k < points_.size(); ++k) sorted_[begin_[square_[k] + 1]++] = points_[k];
}

}  // namespace declutter
