#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "modules/geometry/tabletop.h"
#include "modules/hough_segmenter/table_points.h"

namespace declutter {

// A connected horizontal surface seen from above: the top face of an object. All in T.
struct TopPatch {
  int component = 0;
  float height = 0;                        // [m] median above the support plane
  float sigma = 0;                         // [m] standard deviation of a measurement on it
  std::vector<Eigen::Vector2f> points;     // [m] of all its pixels
  std::vector<Eigen::Vector2f> hull;       // [m] convex, counter-clockwise
  std::vector<Eigen::Vector2f> free_edge;  // [m] of its outline where the face ends; where the
                                           // outline is that of something in front, it does not
};

// Patches of at least min_points points, in row-major order of their first pixels. Neighbouring
// pixels whose heights differ by more than max_step_m belong to different patches. points are those
// of the tabletop; X_TC is the pose of the camera in T.
std::vector<TopPatch> FindTopPatches(const std::vector<TablePoint>& points,
                                     const Tabletop& tabletop, const Eigen::Isometry3d& X_TC,
                                     float max_step_m, int min_points);

// Direction of a side of the smallest rectangle around the hull, a unit vector of the xy plane of
// T.
Eigen::Vector2f MinimumAreaAxis(const TopPatch& patch);

}  // namespace declutter
