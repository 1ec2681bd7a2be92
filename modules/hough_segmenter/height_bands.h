#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "modules/geometry/image_components.h"

namespace declutter {

// Tells faces of different heights apart, with memory that is used again.
class HeightBands {
 public:
  // [m] heights that part the faces in a sample of heights, ascending: valleys of their
  // distribution to half of the peaks beside them, when it is smoothed by the noise of one height,
  // sigma. Between two of them, and beyond, are at least min_num heights. Valid until the next
  // call.
  const std::vector<float>& LimitsBetweenFaces(const std::vector<float>& heights, float sigma,
                                               int min_num);

  // Parts the patches that join faces of different heights: noise bridges a step between
  // neighbouring pixels, but not one between whole faces. mask and heights [m] are row-major,
  // columns * rows long, and labels holds the patch of each marked pixel. True when patches were
  // parted; all are then numbered anew.
  bool Split(int columns, int rows, const std::vector<uint8_t>& mask,
             const std::vector<float>& heights, float max_step_m, int min_pixels,
             const std::vector<int32_t>& labels, ComponentRuns* patches);

 private:
  // Sets distribution_ to the numbers in bins of the heights from `low` on, smoothed by a Gaussian.
  void FindDistribution(const std::vector<float>& heights, float low, float high, float sigma);
  // Sets valleys_ to the bins of the lowest values of distribution_ between two peaks.
  void FindValleys();
  // Sorts the runs of patches by patch.
  void SortRuns(const ComponentRuns& patches);
  template <typename Visit>
  void ForEachPixelOf(size_t patch, const ComponentRuns& patches, Visit visit) const;
  // Lifts the pixels of a patch in smooth_ by the band that they are in, if there are several.
  bool LiftBands(size_t patch, int min_pixels, const std::vector<int32_t>& labels,
                 const ComponentRuns& patches);

  std::vector<float> numbers_, kernel_, distribution_;
  std::vector<size_t> valleys_;
  std::vector<float> limits_;
  std::vector<float> row_means_, smooth_;     // images; anything where there is no patch
  std::vector<size_t> first_run_;             // of each patch in runs_
  std::vector<size_t> runs_;                  // by patch
  std::vector<float> heights_, differences_;  // of one patch
};

}  // namespace declutter
