#pragma once

#include "modules/geometry/depth_image.h"
#include "modules/geometry/solid.h"
#include "modules/model_verifier/model_verifier.pb.h"

namespace declutter {

// Checks hypotheses against the depth image by ray casting: free, occluded and occupied space
// (paper, sections 1 and 4).
class ModelVerifier {
 public:
  explicit ModelVerifier(const ModelVerifierConfig& config);

  // Objects in C with their visible pixels. Frame and hypotheses must be of the same utime.
  ObjectList Verify(const DepthFrame& frame, const HypothesisList& hypotheses) const;

 private:
  ModelVerifierConfig config_;
};

}  // namespace declutter
