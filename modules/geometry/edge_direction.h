#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace declutter {

// Direction of the sides of a rectangle of which some edges are seen, whole or in part: along it
// and across it their points [m] lie on the fewest lines. A unit vector in the first quadrant, to
// 1.5 degrees; nothing for few points.
std::optional<Eigen::Vector2f> EdgeDirection(const std::vector<Eigen::Vector2f>& edge);

}  // namespace declutter
