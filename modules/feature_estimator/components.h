#pragma once

#include <cstdint>
#include <vector>

#include "modules/feature_estimator/point_image.h"

namespace declutter {

// What connects two points: at most reach_px apart in image rows and columns and at most
// max(distance_m, distance_per_z2 * z^2) apart in space, z the nearer one's depth.
struct Connection {
  double distance_m = 0;
  double distance_per_z2 = 0;  // [1/m]
  int reach_px = 0;
};

// Connected components (paper, section 3, step v).
struct ComponentImage {
  int num_components = 0;
  std::vector<int32_t>
      label;  // 0 .. num_components - 1, in the order of their first pixels; -1: none

  // What labelling needs meanwhile, by element: sets, patches of direct neighbours and the ends of
  // their runs, numbers of points; and the elements with a point.
  std::vector<int32_t> parent, patch, run_end, num_points, elements;
};

// Components with fewer than min_points points are dropped. The margin of the points must be at
// least reach_px wide.
ComponentImage LabelComponents(const PointImage& points, const Connection& connection,
                               int min_points, ComponentImage recycled = {});

}  // namespace declutter
