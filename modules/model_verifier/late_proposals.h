#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "modules/geometry/convex_hull.h"
#include "modules/geometry/solid.h"
#include "modules/model_verifier/leaning_boxes.h"
#include "modules/model_verifier/observation.h"
#include "modules/model_verifier/part_completion.h"
#include "modules/model_verifier/surface_parts.h"

namespace declutter {

// A solid laid over points that nothing explained.
struct LateProposal {
  Hypothesis hypothesis;
  int num_px = 0;  // [px] of the sensor that it was laid over
};

// Proposes solids for what is left when all that was proposed before has been tried: what is seen
// of a mostly hidden object may be too little to vote for, or be of one height with its neighbour.
// Memory is used again.
class LateProposer {
 public:
  // selected: what was selected; is_explained: not 0 for each pixel of the grid that needs no
  // solid; min_px: [px] that a solid needs. Only among the selected ones and near them: what is
  // beside the table is none of ours. Valid until the next call.
  const std::vector<LateProposal>& ProposeForUnexplained(const std::vector<Solid>& selected,
                                                         const std::vector<uint8_t>& is_explained,
                                                         double min_px,
                                                         const Observation& observation);

  // Boxes that lean, among or near others, laid over all that is seen. Valid until the next call.
  const std::vector<LateProposal>& ProposeLeaning(const std::vector<Solid>& others,
                                                  const Observation& observation);

 private:
  // Makes region_ the convex hull of solids seen from above, with a margin.
  void SetRegion(const std::vector<Solid>& solids, const Eigen::Isometry3d& X_TC);
  // Boxes that lean, over the marked pixels, in the region.
  void AddLeaning(const PixelWindow& window, const Eigen::Isometry3d& X_TC,
                  const Observation& observation);

  std::vector<LateProposal> proposals_;
  std::vector<uint8_t> is_marked_, is_explained_;
  std::vector<Eigen::Vector2d> corners_, hull_;
  ConvexRegion region_;
  PartFinder parts_;
  PartCompletion completion_;
  LeaningBoxFinder leaning_;
};

}  // namespace declutter
