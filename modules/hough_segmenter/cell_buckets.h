#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "modules/geometry/random_index.h"
#include "modules/hough_segmenter/side_cells.h"

namespace declutter {

// Squares of the table plane with the cells of a component in them, from which a cell near another
// one is drawn at once, however many cells have been removed.
class CellBuckets {
 public:
  void Assign(const std::vector<SideCell>& cells);

  // Takes a cell out, until Restore().
  void Remove(size_t cell);
  // Puts back what was removed since Assign() or the last Keep().
  void Restore() { num_free_ = num_kept_; }
  // Makes removals final.
  void Keep() { num_kept_ = num_free_; }

  // One of the cells that are left in the square of a cell and the eight around it, each as likely
  // as the other; nothing when there are none.
  std::optional<size_t> DrawNear(size_t cell, RandomIndex* random) const;

 private:
  size_t num_columns_ = 0;  // with an empty one at either side
  std::vector<uint32_t> bucket_of_cell_;
  std::vector<uint32_t> begin_;     // of each bucket in cells_
  std::vector<uint32_t> num_free_;  // of each bucket: they come first
  std::vector<uint32_t> num_kept_;  // of each bucket after Restore()
  std::vector<uint32_t> cells_;     // by bucket
  std::vector<uint32_t> place_;     // of each cell in cells_
};

}  // namespace declutter
