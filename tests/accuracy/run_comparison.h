#pragma once

#include <string>
#include <vector>

#include "tests/accuracy/agreement.h"
#include "tests/accuracy/paired_estimate.h"
#include "tests/accuracy/scored_frame.h"

namespace declutter::accuracy {

// One line of the table of two runs.
struct ComparedQuantity {
  std::string name;  // with its unit
  QuantityKind kind = QuantityKind::kCount;
  PairedEstimate estimates;
};

// Recall, precision, false models and errors of both runs over the same scenes with truth.
std::vector<ComparedQuantity> CompareWithTruth(const std::vector<ScoredFrame>& baseline,
                                               const std::vector<ScoredFrame>& candidate);

// Models of each shape, and the share of them that the other run has too.
std::vector<ComparedQuantity> CompareWithEachOther(const std::vector<FrameAgreement>& frames);

}  // namespace declutter::accuracy
