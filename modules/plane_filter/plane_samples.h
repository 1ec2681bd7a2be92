#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

#include "modules/geometry/random_index.h"
#include "modules/plane_filter/inverse_depth.h"

namespace declutter {

// Planes through three random pixels near each other. Draws that meet a gap are repeated, but not
// for ever.
class PlaneSamples {
 public:
  // random is left behind what was drawn from it when this ends.
  PlaneSamples(const InverseDepth& grid, int max_draws, RandomIndex* random);
  ~PlaneSamples();
  PlaneSamples(const PlaneSamples&) = delete;
  PlaneSamples& operator=(const PlaneSamples&) = delete;

  std::optional<InversePlane> Next();

 private:
  // Every draw takes up to three pairs of random numbers: a pixel to begin with, and two offsets.
  static constexpr size_t kPairsOfDraw = 3;
  static constexpr size_t kNumAhead = 256;

  void LookAhead();
  void SkipGaps();
  std::optional<InversePlane> Draw(int reach);

  const InverseDepth& grid_;
  const int max_draws_;
  RandomIndex* const random_;
  int num_drawn_ = 0;
  // The next pairs of random bits, and which stand for a pixel with a measurement.
  std::array<uint32_t, kNumAhead> first_, second_;
  std::array<uint8_t, kNumAhead> is_measured_;
  size_t next_ = 0;  // of the pairs
};

}  // namespace declutter
