#pragma once

#include <cstdint>
#include <vector>

#include "modules/geometry/solid.h"
#include "modules/model_verifier/observation.h"

namespace declutter {

// A standing solid laid over points that nothing explained.
struct LateProposal {
  Hypothesis hypothesis;
  int num_px = 0;  // [px] of the sensor that it was laid over
};

// Proposes solids for what is left when all that was proposed before has been tried: what is seen
// of a mostly hidden object may be too little to vote for, or be of one height with its neighbour.
// selected: what was selected; is_explained: not 0 for each pixel of the grid that needs no solid;
// min_px: [px] that a solid needs. Only among the selected ones and near them: what is beside the
// table is none of ours.
std::vector<LateProposal> ProposeForUnexplained(const std::vector<Solid>& selected,
                                                const std::vector<uint8_t>& is_explained,
                                                double min_px, const Observation& observation);

}  // namespace declutter
