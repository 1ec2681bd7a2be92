#pragma once

#include <vector>

#include "modules/geometry/solid.h"
#include "modules/model_verifier/observation.h"
#include "modules/model_verifier/surface_kernels.h"

namespace declutter {

// The measurements on the surfaces of a solid: what it is fitted to. The buffer is used again.
class SurfacePoints {
 public:
  // Those on the faces of a box, on the top of a cylinder, and between its ends.
  void Find(const Solid& solid, const Observation& observation);

  const SurfacePoint* begin() const { return points_.data(); }
  const SurfacePoint* end() const { return points_.data() + num_; }
  // [px] of the sensor that each stands for.
  int pixel_weight() const { return pixel_weight_; }

 private:
  std::vector<SurfacePoint> points_;
  size_t num_ = 0;
  int pixel_weight_ = 1;
};

}  // namespace declutter
