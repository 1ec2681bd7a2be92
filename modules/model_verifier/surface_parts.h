#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "modules/model_verifier/observation.h"
#include "modules/model_verifier/projection.h"

namespace declutter {

// Points that seem to be of one solid, in the table frame T of the support plane: a top face of one
// height with what is seen below its front edge, or a side without a top.
struct SurfacePart {
  std::vector<Eigen::Vector3f> tops;     // [m]
  std::vector<Eigen::Vector3f> sides;    // [m] all others
  std::vector<Eigen::Vector2f> outline;  // [m] of it seen from above: the sides, and the edge of
                                         // the top where nothing in front cuts it off
  size_t num_points() const { return tops.size() + sides.size(); }
};

// Parts of at least min_points points among the marked pixels of a window of the grid, in row-major
// order of their first pixels. is_marked has one element per pixel of the grid.
std::vector<SurfacePart> FindParts(const std::vector<uint8_t>& is_marked, const PixelWindow& window,
                                   const Eigen::Isometry3d& X_TC, size_t min_points,
                                   const Observation& observation);

}  // namespace declutter
