#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "modules/geometry/solid.h"

namespace declutter::accuracy {

// Models of one frame in two runs. Arrays are by Shape.
struct FrameAgreement {
  std::string frame;
  bool has_baseline = false;  // the run has a line for the frame, without an error
  bool has_candidate = false;
  std::array<int, 2> num_baseline{};
  std::array<int, 2> num_candidate{};
  std::array<int, 2> num_same{};  // pairs whose centres and extents are within 20 mm

  bool IsSame() const;  // both have a result or neither, and every model is one of a pair
};

// Every frame of either run, in the order of names. Models are paired one to one within a shape,
// nearest centres first.
std::vector<FrameAgreement> CompareRuns(const std::map<std::string, ObjectList>& baseline,
                                        const std::map<std::string, ObjectList>& candidate);

}  // namespace declutter::accuracy
