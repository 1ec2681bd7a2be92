#pragma once

#include <cstdint>
#include <vector>

#include "modules/model_verifier/ray_casting.h"

namespace declutter {

// Which of several solids each pixel of a grid was measured on: the one that it fits best.
class PixelOwners {
 public:
  // evidence: of the solids on one grid.
  void Assign(const std::vector<const RayEvidence*>& evidence, int num_pixels);

  // 0: none, i + 1: solid i of those given. Row-major.
  const std::vector<uint8_t>& owners() const { return owners_; }

 private:
  std::vector<uint8_t> owners_;
  std::vector<int32_t> fits_;  // of each pixel with its owner, in kFitUnit
};

}  // namespace declutter
