#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "modules/geometry/reused_list.h"
#include "modules/hough_segmenter/table_points.h"

namespace declutter {

// Side points of one component that share a small column of space, seen from above: what the 2D
// fits work on instead of single points.
struct SideCell {
  Eigen::Vector2f p = Eigen::Vector2f::Zero();  // [m] mean position in the xy plane of T
  Eigen::Vector2f n = Eigen::Vector2f::Zero();  // unit mean horizontal normal
  float z = 0;                                  // [m] mean height above the support plane
  float kappa = 0;                              // [1/m] mean
  float curvature = 0;                          // [1] mean
  float r_min = 0;                              // [m] mean
  float sigma = 0;                              // [m] mean
  float weight = 0;                             // [px] that its points stand for
};

// Gathers points in cells, with memory that is used again.
class SideCells {
 public:
  // Cells of side_m x side_m x height_m of the side points of each component, in order of the
  // components; points whose normal is not nearly horizontal do not count, the others as the pixels
  // that each stands for. The result is valid until the next call.
  const ReusedList<std::vector<SideCell>>& Gather(const std::vector<TablePoint>& points,
                                                  int num_components, float side_m, float height_m,
                                                  int num_pixels = 1);

 private:
  // Of a hash table of all cells by component and place.
  struct Slot {
    uint64_t place = 0;
    int32_t component = -1;  // -1: empty
    uint32_t cell = 0;       // of its component
  };
  Slot* FindSlot(uint64_t place, int32_t component);
  void Use(Slot* slot, const Slot& value);
  void Grow();

  ReusedList<std::vector<SideCell>> cells_;
  std::vector<Slot> slots_ = std::vector<Slot>(4096);  // a power of two
  std::vector<uint32_t> used_;                         // slots
};

}  // namespace declutter
