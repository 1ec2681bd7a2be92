#pragma once

#include <Eigen/Core>
#include <vector>

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
  float weight = 0;                             // number of points
};

// Cells of side_m x side_m x height_m of the side points of each component, in order of the
// components; points whose normal is not nearly horizontal do not count.
std::vector<std::vector<SideCell>> SideCells(const std::vector<TablePoint>& points,
                                             int num_components, float side_m, float height_m);

}  // namespace declutter
