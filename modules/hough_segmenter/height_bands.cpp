#include "modules/hough_segmenter/height_bands.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "modules/hough_segmenter/quantile.h"

namespace declutter {
namespace {

constexpr float kBin = 0.0005f;       // [m] of the distribution of heights
constexpr float kValley = 0.5f;       // of the peak on either side
constexpr size_t kWindow = 5;         // [px] over which noise is averaged
constexpr float kBandOffset = 10.0f;  // [m] more than any step between neighbours

// Mean of num values in steps of stride, of those pixels that are labelled so.
float MeanOf(const float* values, const int32_t* labels, int32_t label, size_t num, size_t stride) {
  float sum = 0;
  int num_summed = 0;
  for (size_t k = 0; k < num; ++k) {
    const bool is_same = labels[k * stride] == label;
    sum += is_same ? values[k * stride] : 0.0f;
    num_summed += is_same;
  }
  return sum / static_cast<float>(num_summed);
}

// The mean at each pixel of a patch of those of the same patch in a window along a line of the
// image; at(pixel, row) is its place in the line of length pixels, stride apart.
template <typename At>
void SmoothAlong(const ComponentRuns& patches, const std::vector<int32_t>& labels,
                 const std::vector<float>& values, size_t columns, size_t length, size_t stride,
                 At at, std::vector<float>* means) {
  constexpr size_t kReach = kWindow / 2;
  means->resize(values.size());
  for (const ComponentRun& run : patches.runs) {
    const size_t row = run.begin / columns;
    for (size_t i = run.begin; i < run.end; ++i) {
      const size_t before = std::min(kReach, at(i, row));
      const size_t after = std::min(kReach, length - 1 - at(i, row));
      const size_t first = i - before * stride;
      const bool is_whole = before + after + 1 == kWindow;  // the usual case, without a loop
      (*means)[i] = MeanOf(&values[first], &labels[first], run.component,
                           is_whole ? kWindow : before + after + 1, stride);
    }
  }
}

// Standard deviation of values of which the absolute differences of pairs are given.
float SigmaOf(std::vector<float>* differences) {
  constexpr float kSigmaOfMedian = 1.4826f / 1.4142f;
  return std::max(kBin, kSigmaOfMedian * Quantile(differences, 0.5));
}

}  // namespace

void HeightBands::FindDistribution(const std::vector<float>& heights, float low, float high,
                                   float sigma) {
  const auto num_bins = static_cast<size_t>((high - low) / kBin) + 1;
  numbers_.assign(num_bins, 0);
  for (const float height : heights) ++numbers_[static_cast<size_t>((height - low) / kBin)];
  const auto reach = static_cast<size_t>(std::ceil(3 * sigma / kBin));
  kernel_.clear();
  for (size_t k = 0; k <= reach; ++k) {
    const float x = static_cast<float>(k) * kBin / sigma;
    kernel_.push_back(std::exp(-0.5f * x * x));
  }
  distribution_.assign(num_bins, 0);
  for (size_t i = 0; i < num_bins; ++i) {
    for (size_t j = i - std::min(i, reach); j < std::min(num_bins, i + reach + 1); ++j) {
      distribution_[i] += kernel_[i > j ? i - j : j - i] * numbers_[j];
    }
  }
}

void HeightBands::FindValleys() {
  valleys_.clear();
  float peak = 0;
  size_t lowest = 0;
  bool is_falling = false;
  for (size_t i = 0; i < distribution_.size(); ++i) {
    const float value = distribution_[i];
    if (!is_falling) {
      peak = std::max(peak, value);
      is_falling = value < kValley * peak;
      lowest = i;
    } else if (value < distribution_[lowest]) {
      lowest = i;
    } else if (kValley * value > distribution_[lowest]) {
      valleys_.push_back(lowest);
      peak = value;
      is_falling = false;
    }
  }
}

const std::vector<float>& HeightBands::LimitsBetweenFaces(const std::vector<float>& heights,
                                                          float sigma, int min_num) {
  limits_.clear();
  if (heights.empty() || sigma <= 0) return limits_;
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  FindDistribution(heights, *low, *high, sigma);
  FindValleys();
  for (const size_t bin : valleys_) {
    const float limit = *low + (static_cast<float>(bin) + 0.5f) * kBin;
    const float previous = limits_.empty() ? *low - kBin : limits_.back();
    const auto num_between = std::count_if(heights.begin(), heights.end(), [&](float height) {
      return height > previous && height <= limit;
    });
    const auto num_above =
        std::count_if(heights.begin(), heights.end(), [&](float height) { return height > limit; });
    if (num_between >= min_num && num_above >= min_num) limits_.push_back(limit);
  }
  return limits_;
}

void HeightBands::SortRuns(const ComponentRuns& patches) {
  // first_run_[p + 2] counts, then begins, and at last first_run_[p + 1] ends the runs of patch p.
  first_run_.assign(patches.num_pixels.size() + 2, 0);
  for (const ComponentRun& run : patches.runs) {
    ++first_run_[static_cast<size_t>(run.component) + 2];
  }
  for (size_t p = 2; p < first_run_.size(); ++p) first_run_[p] += first_run_[p - 1];
  runs_.resize(patches.runs.size());
  for (size_t k = 0; k < patches.runs.size(); ++k) {
    runs_[first_run_[static_cast<size_t>(patches.runs[k].component) + 1]++] = k;
  }
}

template <typename Visit>
void HeightBands::ForEachPixelOf(size_t patch, const ComponentRuns& patches, Visit visit) const {
  for (size_t k = first_run_[patch]; k < first_run_[patch + 1]; ++k) {
    const ComponentRun& run = patches.runs[runs_[k]];
    for (size_t i = run.begin; i < run.end; ++i) visit(i);
  }
}

bool HeightBands::LiftBands(size_t patch, int min_pixels, const std::vector<int32_t>& labels,
                            const ComponentRuns& patches) {
  heights_.clear();
  differences_.clear();
  ForEachPixelOf(patch, patches, [&](size_t i) {
    heights_.push_back(smooth_[i]);
    if (i >= kWindow && labels[i - kWindow] == labels[i]) {
      differences_.push_back(std::abs(smooth_[i] - smooth_[i - kWindow]));
    }
  });
  if (differences_.empty()) return false;
  LimitsBetweenFaces(heights_, SigmaOf(&differences_), min_pixels);
  if (limits_.empty()) return false;
  ForEachPixelOf(patch, patches, [this](size_t i) {
    const auto is_below = [height = smooth_[i]](float limit) { return height > limit; };
    const auto band = std::count_if(limits_.begin(), limits_.end(), is_below);
    for (std::ptrdiff_t k = 0; k < band; ++k) smooth_[i] += kBandOffset;
  });
  return true;
}

bool HeightBands::Split(int columns, int rows, const std::vector<uint8_t>& mask,
                        const std::vector<float>& heights, float max_step_m, int min_pixels,
                        const std::vector<int32_t>& labels, ComponentRuns* patches) {
  const auto width = static_cast<size_t>(columns);
  SmoothAlong(
      *patches, labels, heights, width, width, 1,
      [width](size_t pixel, size_t row) { return pixel - row * width; }, &row_means_);
  SmoothAlong(
      *patches, labels, row_means_, width, static_cast<size_t>(rows), width,
      [](size_t, size_t row) { return row; }, &smooth_);
  SortRuns(*patches);
  bool is_split = false;
  for (size_t patch = 0; patch < patches->num_pixels.size(); ++patch) {
    if (patches->num_pixels[patch] < 2 * min_pixels) continue;
    is_split |= LiftBands(patch, min_pixels, labels, *patches);
  }
  if (is_split) {
    *patches = FindComponents(columns, rows, mask, smooth_, max_step_m, std::move(*patches));
  }
  return is_split;
}

}  // namespace declutter
