#pragma once

#include <Eigen/Core>

namespace declutter {

// Outline of an upright solid seen from above, in the xy plane of W: a turned rectangle or a
// circle.
struct Footprint {
  bool round = false;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  // [m]
  Eigen::Vector2d half = Eigen::Vector2d::Zero();    // [m] half extents; circle: radius twice
  double yaw_rad = 0;
};

// [m] distance between two footprints; negative when they overlap.
double Gap(const Footprint& a, const Footprint& b);

// Whether every point of `inner` is at least margin_m inside `outer`.
bool Contains(const Footprint& outer, const Footprint& inner, double margin_m);

// [m] half extents of the upright rectangle around a footprint.
Eigen::Vector2d HalfBounds(const Footprint& footprint);

}  // namespace declutter
