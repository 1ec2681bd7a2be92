#include "modules/hough_segmenter/cell_buckets.h"

#include <utility>

namespace declutter {
namespace {

constexpr float kSide = 0.05f;  // [m]

}  // namespace

void CellBuckets::Assign(const std::vector<SideCell>& cells) {
  Eigen::Vector2f low = cells.empty() ? Eigen::Vector2f::Zero() : cells[0].p;
  Eigen::Vector2f high = low;
  for (const SideCell& cell : cells) {
    low = low.cwiseMin(cell.p);
    high = high.cwiseMax(cell.p);
  }
  num_columns_ = static_cast<size_t>((high.x() - low.x()) / kSide) + 3;
  const size_t num_rows = static_cast<size_t>((high.y() - low.y()) / kSide) + 3;
  num_kept_.assign(num_columns_ * num_rows, 0);
  bucket_of_cell_.clear();
  for (const SideCell& cell : cells) {
    const Eigen::Vector2f q = (cell.p - low) / kSide;
    const size_t bucket =
        (static_cast<size_t>(q.y()) + 1) * num_columns_ + static_cast<size_t>(q.x()) + 1;
    bucket_of_cell_.push_back(static_cast<uint32_t>(bucket));
    ++num_kept_[bucket];
  }
  begin_.resize(num_kept_.size());
  uint32_t sum = 0;
  for (size_t bucket = 0; bucket < begin_.size(); ++bucket) {
    begin_[bucket] = sum;
    sum += num_kept_[bucket];
  }
  num_free_.assign(num_kept_.size(), 0);
  cells_.resize(cells.size());
  place_.resize(cells.size());
  for (size_t i = 0; i < cells.size(); ++i) {
    const uint32_t bucket = bucket_of_cell_[i];
    place_[i] = begin_[bucket] + num_free_[bucket]++;
    cells_[place_[i]] = static_cast<uint32_t>(i);
  }
}

void CellBuckets::Remove(size_t cell) {
  const uint32_t bucket = bucket_of_cell_[cell];
  const uint32_t place = place_[cell];
  const uint32_t last = begin_[bucket] + --num_free_[bucket];
  std::swap(cells_[place], cells_[last]);
  place_[cells_[place]] = place;
  place_[cell] = last;
}

std::optional<size_t> CellBuckets::DrawNear(size_t cell, RandomIndex* random) const {
  const size_t first = bucket_of_cell_[cell] - num_columns_ - 1;
  const uint32_t* rows[3];
  uint32_t num_in_row[3];
  for (size_t row = 0; row < 3; ++row) {
    rows[row] = &num_free_[first + row * num_columns_];
    num_in_row[row] = rows[row][0] + rows[row][1] + rows[row][2];
  }
  const uint32_t total = num_in_row[0] + num_in_row[1] + num_in_row[2];
  if (total == 0) return std::nullopt;
  auto rank = static_cast<uint32_t>((*random)(total));
  // Row and column without branches, which would depend on chance.
  const auto pick = [&rank](const uint32_t* num) {
    const uint32_t num_of_two = num[0] + num[1];
    const bool is_after_one = rank >= num[0];
    const bool is_after_two = rank >= num_of_two;
    rank -= is_after_two ? num_of_two : (is_after_one ? num[0] : 0);
    return size_t{is_after_one} + size_t{is_after_two};
  };
  const size_t row = pick(num_in_row);
  const size_t column = pick(rows[row]);
  return cells_[begin_[first + row * num_columns_ + column] + rank];
}

}  // namespace declutter
