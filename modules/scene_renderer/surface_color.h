#pragma once

#include <Eigen/Core>
#include <vector>

#include "modules/geometry/depth_image.h"
#include "modules/geometry/solid.h"
#include "modules/scene_renderer/ray_caster.h"

namespace declutter {

// How a solid is painted.
enum class Material : int8_t { kPrinted = 0, kWood = 1, kPlain = 2 };

struct Paint {
  Eigen::Vector3d color = {0.6, 0.6, 0.6};  // 0..1
  Material material = Material::kPlain;
};

// A photograph of the ideal image for people to look at: one distant lamp and daylight. `solids`
// and `paints` are those the image was made of; up_C is the direction of the sky.
ColorImage Photograph(const IdealImage& ideal, const std::vector<Solid>& solids,
                      const std::vector<Paint>& paints, const Eigen::Vector3d& up_C);

}  // namespace declutter
