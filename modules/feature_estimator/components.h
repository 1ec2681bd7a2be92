#pragma once

#include <cstdint>
#include <vector>

#include "modules/feature_estimator/point_image.h"
#include "modules/geometry/disjoint_sets.h"

namespace declutter {

// What connects two points: at most reach_px apart in image rows and columns and at most
// max(distance_m, distance_per_z2 * z^2) apart in space, z the nearer one's depth.
struct Connection {
  double distance_m = 0;
  double distance_per_z2 = 0;  // [1/m]
  int reach_px = 0;
};

// Points of one row, each connected with the next one: elements begin .. end - 1.
struct PointRun {
  size_t begin = 0, end = 0;
  float z_min = 0, z_max = 0;  // [m]
  int32_t component = -1;      // -1: none
};

// Connected components (paper, section 3, step v), numbered in the order of their first pixels.
struct Components {
  int num_components = 0;
  std::vector<PointRun> runs;  // of all points, in row-major order

  // What finding them needs meanwhile: the first run of each row, the set of each run and its
  // number of points.
  std::vector<size_t> first_run;
  DisjointSets sets;
  std::vector<int32_t> num_points;
  std::vector<uint8_t> joined, edges;  // where runs go on, and begin or end, in a row
};

// Components with fewer than min_points points are dropped. The margin of the points must be at
// least reach_px wide.
Components FindComponents(const PointImage& points, const Connection& connection, int min_points,
                          Components recycled = {});

}  // namespace declutter
