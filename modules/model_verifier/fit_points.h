#pragma once

#include "modules/geometry/solid.h"
#include "modules/geometry/uninitialized.h"
#include "modules/model_verifier/fit_kernels.h"
#include "modules/model_verifier/observation.h"

namespace declutter {

// The measurements on the surfaces of a solid: what it is fitted to. The buffer is used again.
class FitPoints {
 public:
  // Those on the faces of a box, on the top of a cylinder, and between its ends.
  void Find(const Solid& solid, const Observation& observation);

  const FitArrays& arrays() const { return arrays_; }
  // [px] of the sensor that each stands for.
  int pixel_weight() const { return pixel_weight_; }

 private:
  UninitializedVector<float> buffer_;
  UninitializedVector<int32_t> surfaces_;
  FitArrays arrays_;
  int pixel_weight_ = 1;
};

}  // namespace declutter
