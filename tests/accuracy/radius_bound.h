#pragma once

#include <optional>
#include <vector>

#include "modules/geometry/depth_image.h"
#include "modules/geometry/solid.h"
#include "modules/scene_renderer/scene.pb.h"

namespace declutter::accuracy {

// [m] the Cramer-Rao bound of a cylinder's radius: the least standard deviation of an unbiased
// estimate from one rendered depth image that knows the direction of the axis, but not its place.
// pixels are those that measure the cylinder, row * width + column; beyond the noise's
// max_incidence they do not count. Their errors, rounding among them, are independent ("white"), or
// those of one window of the noise's box filter are one ("real_sensor"); its smooth field does not
// count. Nothing without noise, or where the side is seen by too few to tell.
std::optional<double> RadiusBound(const Solid& cylinder, const PinholeCamera& camera,
                                  const std::vector<int>& pixels, const SceneNoise& noise);

}  // namespace declutter::accuracy
