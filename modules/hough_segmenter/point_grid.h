#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <vector>

#include "modules/hough_segmenter/table_points.h"

namespace declutter {

// Points of a frame by squares of the table plane, so that a query looks at those nearby alone.
// Memory is used again.
class PointGrid {
 public:
  static constexpr float kSide = 0.01f;             // [m]
  static constexpr float kHalfDiagonal = 0.00708f;  // [m]

  // Takes the points for which condition(point) holds.
  template <typename Condition>
  void Assign(const std::vector<TablePoint>& points, Condition condition) {
    points_.clear();
    for (const TablePoint& point : points) {
      if (condition(point)) points_.push_back(point);
    }
    Sort();
  }

  // Calls visit(point) for the points in squares that reach into the box and for whose middle
  // touches(middle) holds, and perhaps for others.
  template <typename Touches, typename Visit>
  void ForEachIn(const Eigen::AlignedBox2f& box, Touches touches, Visit visit) const {
    const Eigen::Vector2i first = SquareOf(box.min()), last = SquareOf(box.max());
    for (int row = first.y(); row <= last.y(); ++row) {
      for (int column = first.x(); column <= last.x(); ++column) {
        const size_t square = static_cast<size_t>(row * num_columns_ + column);
        if (begin_[square] == begin_[square + 1]) continue;
        if (!touches(low_ + kSide * Eigen::Vector2f(static_cast<float>(column) + 0.5f,
                                                    static_cast<float>(row) + 0.5f))) {
          continue;
        }
        for (uint32_t k = begin_[square]; k < begin_[square + 1]; ++k) visit(sorted_[k]);
      }
    }
  }

  template <typename Visit>
  void ForEachIn(const Eigen::AlignedBox2f& box, Visit visit) const {
    ForEachIn(
        box, [](const Eigen::Vector2f&) { return true; }, visit);
  }

  // [m] the largest standard deviation among the points.
  float max_sigma() const { return max_sigma_; }

 private:
  void Sort();
  // Of the nearest square that there is.
  Eigen::Vector2i SquareOf(const Eigen::Vector2f& p) const {
    const Eigen::Vector2f q = (p - low_) / kSide;
    return {static_cast<int>(std::clamp(q.x(), 0.0f, static_cast<float>(num_columns_ - 1))),
            static_cast<int>(std::clamp(q.y(), 0.0f, static_cast<float>(num_rows_ - 1)))};
  }

  Eigen::Vector2f low_ = Eigen::Vector2f::Zero();
  int num_columns_ = 1;
  int num_rows_ = 1;
  float max_sigma_ = 0;
  std::vector<SurfacePoint> points_;
  std::vector<uint32_t> square_;          // of each point
  std::vector<uint32_t> begin_ = {0, 0};  // of each square in sorted_
  std::vector<SurfacePoint> sorted_;      // by square
};

}  // namespace declutter
