#include "modules/model_verifier/separate_fits.h"

#include <algorithm>
#include <cmath>

#include "modules/model_verifier/refinement.h"

namespace declutter {
namespace {

// After which the place of a solid no longer depends on where it was proposed.
constexpr int kNumFits = 2;

// What holds both.
PixelWindow Union(const PixelWindow& a, const PixelWindow& b) {
  return {std::min(a.u_begin, b.u_begin), std::max(a.u_end, b.u_end),
          std::min(a.v_begin, b.v_begin), std::max(a.v_end, b.v_end)};
}

}  // namespace

void SeparateFits::Run(const ObservedImage& observed, const std::vector<Candidate*>& candidates,
                       FitBuffers* buffers) {
  if (candidates.empty()) return;
  const Observation half = observed.every_second_pixel();
  const Observation all = observed.every_pixel();
  const Observation apart{all.image, grid_, all.normals, all.support};
  std::vector<const RayEvidence*> evidence;
  for (const Candidate* candidate : candidates) evidence.push_back(&candidate->evidence);
  std::vector<char> is_fitted(candidates.size(), 1);
  grid_ = all.grid;
  PixelWindow marked = evidence[0]->window;
  for (int fit = 0; fit < kNumFits; ++fit) {
    owners_.Assign(evidence, half.grid.num_pixels());
    for (const RayEvidence* of_solid : evidence) marked = Union(marked, of_solid->window);
    Mark(all.grid, marked);
    for (size_t i = 0; i < candidates.size(); ++i) {
      if (!is_fitted[i]) continue;
      Candidate& candidate = *candidates[i];
      Solid* const solid = &candidate.hypothesis.solid;
      const PixelWindow window = candidate.evidence.window;
      Claim(i, window);
      is_fitted[i] = fit == 0 ? RefineOrClimb(apart, half, solid, &candidate.evidence, buffers)
                              : RefineIfNoWorse(apart, half, solid, &candidate.evidence, buffers);
      Mark(all.grid, window);
    }
  }
}

// In a window of every second pixel, and around it, makes the depths negative that belong to any
// solid. Those between every second pixel do where all around them do.
void SeparateFits::Mark(const PixelGrid& all, const PixelWindow& window) {
  const int columns = (all.columns + 1) / 2, rows = (all.rows + 1) / 2;
  const int i_begin = std::max(0, window.u_begin - 1), i_end = std::min(columns, window.u_end + 1);
  const int j_begin = std::max(0, window.v_begin - 1), j_end = std::min(rows, window.v_end + 1);
  const uint8_t* const owners = owners_.owners().data();
  for (int j = j_begin; j < j_end; ++j) {
    const uint8_t* here = owners + j * columns;
    const uint8_t* below = owners + std::min(j + 1, rows - 1) * columns;
    float* z[2];
    for (int k = 0; k < 2; ++k) {
      const auto begin = static_cast<size_t>(std::min(2 * j + k, all.rows - 1)) * all.stride;
      z[k] = &grid_.z[begin];
      std::copy(&all.z[begin] + 2 * i_begin, &all.z[begin] + 2 * i_end, z[k] + 2 * i_begin);
    }
    for (int i = i_begin; i < i_end; ++i) {
      if (here[i] == 0) continue;
      const bool is_right = i + 1 < columns && here[i + 1] != 0;
      const bool is_below = j + 1 < rows && below[i] != 0;
      z[0][2 * i] *= -1;
      if (is_right) z[0][2 * i + 1] *= -1;
      if (is_below) z[1][2 * i] *= -1;
      if (is_right && is_below && below[i + 1] != 0) z[1][2 * i + 1] *= -1;
    }
  }
}

// Makes what is around the pixels of a solid in a window of every second pixel its own.
void SeparateFits::Claim(size_t index, const PixelWindow& window) {
  const int columns = (grid_.columns + 1) / 2;
  for (int j = window.v_begin; j < window.v_end; ++j) {
    const uint8_t* owners = &owners_.owners()[static_cast<size_t>(j * columns)];
    for (int i = window.u_begin; i < window.u_end; ++i) {
      if (owners[i] != index + 1) continue;
      for (int v = std::max(0, 2 * j - 1); v < std::min(2 * j + 2, grid_.rows); ++v) {
        float* z = &grid_.z[static_cast<size_t>(v) * grid_.stride];
        for (int u = std::max(0, 2 * i - 1); u < 2 * i + 2; ++u) z[u] = std::abs(z[u]);
      }
    }
  }
}

}  // namespace declutter
