#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "tests/accuracy/scored_frame.h"
#include "tests/accuracy/summary.h"

namespace declutter::accuracy {

// One line of a report about an object that was missed or a model that is not right.
struct Remark {
  enum class Kind : int8_t { kMiss, kFalse, kNeutral };
  Kind kind;
  std::string text;  // which object or model, and why
};
std::vector<Remark> RemarksOn(const ScoredFrame& frame);

// "120 x 80 x 40 mm" or "r 33 h 101 mm".
std::string SizeText(Shape shape, const Eigen::Vector3d& size);

// Every remark on every frame, a line each.
void WriteRemarks(const std::vector<ScoredFrame>& frames, std::ostream& out);

// Each frame's true boxes and cylinders beside what was found: shape, size, position and error.
void WriteComparison(const std::vector<ScoredFrame>& frames, std::ostream& out);

// Recall, precision and errors.
void WriteTotals(const Summary& summary, std::ostream& out);

}  // namespace declutter::accuracy
