#pragma once

#include <vector>

#include "modules/geometry/solid.h"
#include "modules/model_verifier/fit_kernels.h"
#include "modules/model_verifier/observation.h"

namespace declutter {

// The measurements on the surfaces of a solid: what it is fitted to. The buffer is used again.
class FitPoints {
 public:
  // Those on the faces of a box, on the top of a cylinder, and between its ends.
  void Find(const Solid& solid, const Observation& observation);

  const FitPoint* begin() const { return points_.data(); }
  const FitPoint* end() const { return points_.data() + num_; }
  // [px] of the sensor that each stands for.
  int pixel_weight() const { return pixel_weight_; }

 private:
  std::vector<FitPoint> points_;
  size_t num_ = 0;
  int pixel_weight_ = 1;
};

}  // namespace declutter
