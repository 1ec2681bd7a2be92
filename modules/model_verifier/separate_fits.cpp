#include "modules/model_verifier/separate_fits.h"

#include <algorithm>
#include <cmath>

#include "modules/model_verifier/refinement.h"

namespace declutter {
namespace {

// After which the place of a solid no longer depends on where it was proposed.
constexpr int kMaxFits = 2;
constexpr double kRest = 5e-5;  // [m] of a fit after which a solid is left

// How far a solid was moved, or its size changed [m].
double Change(const Solid& from, const Solid& to) {
  const Eigen::Vector3d shift = to.X_CO.translation() - from.X_CO.translation();
  return std::max(shift.cwiseAbs().maxCoeff(), (to.size - from.size).cwiseAbs().maxCoeff());
}

}  // namespace

void SeparateFits::Run(const ObservedImage& observed, const std::vector<Candidate*>& candidates,
                       FitBuffers* buffers) {
  if (candidates.empty()) return;
  const Observation half = observed.every_second_pixel();
  const Observation all = observed.every_pixel();
  const Observation apart = all.At(grid_);
  evidence_.clear();
  for (const Candidate* candidate : candidates) evidence_.push_back(&candidate->evidence);
  is_moving_.assign(candidates.size(), 1);
  grid_ = all.grid;
  for (int fit = 0; fit < kMaxFits; ++fit) {
    if (fit > 0) Mark();  // nothing is marked
    owners_.Assign(evidence_, half.grid.num_pixels());
    Mark();
    for (size_t i = 0; i < candidates.size(); ++i) {
      if (!is_moving_[i]) continue;
      Candidate& candidate = *candidates[i];
      Solid* const solid = &candidate.hypothesis.solid;
      const PixelWindow window = candidate.evidence.window;
      const Solid before = *solid;
      Claim(i, window);
      // A cylinder that is too large would explain what touches it.
      const bool is_cylinder = solid->shape == Shape::kCylinder;
      const Observation judging =
          is_cylinder ? half.For(static_cast<uint8_t>(i + 1), owners_.owners()) : half;
      RayEvidence* const evidence = is_cylinder ? &own_ : &candidate.evidence;
      if (is_cylinder) CastRays(before, judging, evidence);
      const FitResult result = fit == 0 ? RefineOrClimb(apart, judging, solid, evidence, buffers)
                                        : RefineIfNoWorse(apart, judging, solid, evidence, buffers);
      const double change = Change(before, *solid);
      is_moving_[i] = result.is_fitted && change > kRest;
      if (is_cylinder && change > 0) CastRays(*solid, half, &candidate.evidence);
      for (const ptrdiff_t pixel : claimed_) grid_.z[static_cast<size_t>(pixel)] *= -1;
    }
  }
}

// Changes the sign of the depths that belong to any solid. Those between every second pixel do
// where all around them do.
void SeparateFits::Mark() {
  const int columns = (grid_.columns + 1) / 2, rows = (grid_.rows + 1) / 2;
  for (int j = 0; j < rows; ++j) {
    const uint8_t* here = &owners_.owners()[static_cast<size_t>(j * columns)];
    const uint8_t* below = here + (j + 1 < rows ? columns : 0);
    float* const z = &grid_.z[static_cast<size_t>(2 * j) * grid_.stride];
    float* const z_below = j + 1 < rows ? z + grid_.stride : nullptr;
    for (int i = 0; i < columns; ++i) {
      if (here[i] == 0) continue;
      const bool is_right = i + 1 < columns && here[i + 1] != 0;
      const bool is_below = z_below != nullptr && below[i] != 0;
      z[2 * i] *= -1;
      if (is_right) z[2 * i + 1] *= -1;
      if (is_below) z_below[2 * i] *= -1;
      if (is_right && is_below && below[i + 1] != 0) z_below[2 * i + 1] *= -1;
    }
  }
}

// Makes what is around the pixels of a solid in a window of every second pixel its own.
void SeparateFits::Claim(size_t index, const PixelWindow& window) {
  const int columns = (grid_.columns + 1) / 2;
  const auto owner = static_cast<uint8_t>(index + 1);
  const auto stride = static_cast<ptrdiff_t>(grid_.stride);
  float* const z = grid_.z.data();
  claimed_.clear();
  const auto claim = [&](ptrdiff_t pixel) {
    if (z[pixel] >= 0) return;
    z[pixel] *= -1;
    claimed_.push_back(pixel);
  };
  for (int j = window.v_begin; j < window.v_end; ++j) {
    const uint8_t* const here = &owners_.owners()[static_cast<size_t>(j * columns)];
    const bool has_below = 2 * j + 1 < grid_.rows;
    for (int i = window.u_begin; i < window.u_end; ++i) {
      if (here[i] != owner) continue;
      const ptrdiff_t pixel = 2 * (j * stride + i);
      // What lies before a pixel was claimed by the one there, if that is its own too.
      const bool is_first = i > 0 && here[i - 1] != owner;
      for (ptrdiff_t k = is_first ? -1 : 0; k < 2; ++k) {
        claim(pixel + k);
        if (has_below) claim(pixel + stride + k);
        if (j > 0) claim(pixel - stride + k);
      }
    }
  }
}

}  // namespace declutter
