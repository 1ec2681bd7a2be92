#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace declutter::accuracy {

// What one frame adds to a quantity.
struct FrameShare {
  double part = 0;             // of a share: its numerator; of a count: what is counted
  double whole = 0;            // of a share: its denominator
  std::vector<double> errors;  // of a median
};

enum class QuantityKind : int8_t { kShare, kCount, kMedianAbsoluteError };

// A number with its 95 % interval.
struct Estimate {
  double value = 0;
  double low = 0;
  double high = 0;
};

// Empty where there is nothing to measure; the difference is the candidate's less the baseline's.
struct PairedEstimate {
  std::optional<Estimate> baseline;
  std::optional<Estimate> candidate;
  std::optional<Estimate> difference;
};

// Wilson's score interval of a share. Throws std::logic_error unless 0 <= part <= whole > 0.
Estimate WilsonInterval(double part, double whole);

// Both runs' values of a quantity, from the same frames in the same order. A share has Wilson's
// interval; all else, and every difference, the percentile interval of a bootstrap that draws whole
// frames, the same for both runs, from a fixed seed. Throws std::logic_error when the frames are
// not as many.
PairedEstimate EstimatePair(QuantityKind kind, const std::vector<FrameShare>& baseline,
                            const std::vector<FrameShare>& candidate);

}  // namespace declutter::accuracy
