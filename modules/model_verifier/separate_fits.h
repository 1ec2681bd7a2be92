#pragma once

#include <cstddef>
#include <vector>

#include "modules/model_verifier/model_selection.h"
#include "modules/model_verifier/pixel_owners.h"

namespace declutter {

// Fits the solids that were selected to all pixels, each without those that another one explains
// better: what touches or continues a face would move it. Buffers are used again.
class SeparateFits {
 public:
  // candidates: at most 255, whose evidence is that on every second pixel; it is renewed.
  void Run(const ObservedImage& observed, const std::vector<Candidate*>& candidates,
           FitBuffers* buffers);

 private:
  void Mark();
  void Claim(size_t index, const PixelWindow& window);

  PixelOwners owners_;  // of every second pixel
  PixelGrid grid_;      // of every pixel; depths are negative between pixels that all have an owner
  std::vector<const RayEvidence*> evidence_;  // of each candidate
  std::vector<char> is_moving_;               // the same
  std::vector<ptrdiff_t> claimed_;            // pixels of grid_, by the solid that is fitted
  RayEvidence own_;                           // of that cylinder, without what others own
};

}  // namespace declutter
