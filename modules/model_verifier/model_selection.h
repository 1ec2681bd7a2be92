#pragma once

#include <vector>

#include "modules/geometry/solid.h"
#include "modules/model_verifier/model_verifier.pb.h"
#include "modules/model_verifier/ray_casting.h"

namespace declutter {

// A hypothesis with what the depth image says of it.
struct Candidate {
  Hypothesis hypothesis;
  RayEvidence evidence;
  bool is_refined = false;
  bool is_out = false;  // does not take part
  bool is_selected = false;
  int num_blockers = 0;     // selected candidates in its space
  double misfit_share = 0;  // of its pixels, that count against it as its side has another shape
  double gain = 0;          // [px] explained by it alone, less what speaks against it
};

// The set of solids that explains the image best: takes the hypothesis that explains the most
// pixels nobody else explains, again and again, until none explains enough; then exchanges those
// whose place another fills better. Solids do not share space.
std::vector<Candidate> SelectModels(const ModelVerifierConfig& config,
                                    const std::vector<Hypothesis>& hypotheses,
                                    const Observation& observation);

}  // namespace declutter
