#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "modules/geometry/solid.h"

namespace declutter {

// Splits boxes, with memory that is used again.
class BoxSplitter {
 public:
  // The two boxes side by side that hold the points in the least area seen from above, when that is
  // clearly less than one box does. points_O are measured points on the surface of the box, in its
  // frame.
  std::optional<std::array<Solid, 2>> Split(const Solid& box,
                                            const std::vector<Eigen::Vector3d>& points_O);

 private:
  std::array<std::vector<double>, 2> coordinates_;  // x and y of points
};

}  // namespace declutter
