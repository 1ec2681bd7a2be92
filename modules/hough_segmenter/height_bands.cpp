#include "modules/hough_segmenter/height_bands.h"

#include <algorithm>
#include <cmath>

namespace declutter {
namespace {

constexpr float kBin = 0.0005f;       // [m] of the distribution of heights
constexpr float kValley = 0.5f;       // of the peak on either side
constexpr float kBandOffset = 10.0f;  // [m] more than any step between neighbours

// Numbers in bins of the heights from `low` on, smoothed by a Gaussian.
std::vector<float> Distribution(const std::vector<float>& heights, float low, float high,
                                float sigma) {
  const auto num_bins = static_cast<int>((high - low) / kBin) + 1;
  std::vector<float> numbers(static_cast<size_t>(num_bins), 0);
  for (const float height : heights) ++numbers[static_cast<size_t>((height - low) / kBin)];
  const int reach = static_cast<int>(std::ceil(3 * sigma / kBin));
  std::vector<float> kernel;
  for (int k = 0; k <= reach; ++k) {
    const float x = static_cast<float>(k) * kBin / sigma;
    kernel.push_back(std::exp(-0.5f * x * x));
  }
  std::vector<float> smooth(numbers.size(), 0);
  for (int i = 0; i < num_bins; ++i) {
    for (int j = std::max(0, i - reach); j < std::min(num_bins, i + reach + 1); ++j) {
      smooth[static_cast<size_t>(i)] +=
          kernel[static_cast<size_t>(std::abs(i - j))] * numbers[static_cast<size_t>(j)];
    }
  }
  return smooth;
}

// Bins of the lowest values between peaks at least 1 / kValley as high.
std::vector<size_t> Valleys(const std::vector<float>& values) {
  std::vector<size_t> valleys;
  float peak = 0;
  size_t lowest = 0;
  bool is_falling = false;
  for (size_t i = 0; i < values.size(); ++i) {
    if (!is_falling) {
      peak = std::max(peak, values[i]);
      is_falling = values[i] < kValley * peak;
      lowest = i;
    } else if (values[i] < values[lowest]) {
      lowest = i;
    } else if (kValley * values[i] > values[lowest]) {
      valleys.push_back(lowest);
      peak = values[i];
      is_falling = false;
    }
  }
  return valleys;
}

}  // namespace

std::vector<float> HeightsBetweenFaces(const std::vector<float>& heights, float sigma,
                                       int min_num) {
  if (heights.empty() || sigma <= 0) return {};
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  std::vector<float> limits;
  for (const size_t bin : Valleys(Distribution(heights, *low, *high, sigma))) {
    const float limit = *low + (static_cast<float>(bin) + 0.5f) * kBin;
    const float previous = limits.empty() ? *low - kBin : limits.back();
    const auto num_between = std::count_if(heights.begin(), heights.end(), [&](float height) {
      return height > previous && height <= limit;
    });
    const auto num_above =
        std::count_if(heights.begin(), heights.end(), [&](float height) { return height > limit; });
    if (num_between >= min_num && num_above >= min_num) limits.push_back(limit);
  }
  return limits;
}

void SplitAtHeights(int columns, int rows, const std::vector<float>& heights,
                    const std::vector<float>& sigmas, float max_step_m, int min_pixels,
                    ImageComponents* patches) {
  const size_t num_patches = patches->num_pixels.size();
  std::vector<std::vector<float>> patch_heights(num_patches);
  std::vector<float> sigma_sums(num_patches, 0);
  for (size_t i = 0; i < heights.size(); ++i) {
    if (patches->label[i] < 0) continue;
    const auto label = static_cast<size_t>(patches->label[i]);
    patch_heights[label].push_back(heights[i]);
    sigma_sums[label] += sigmas[i];
  }
  std::vector<std::vector<float>> limits(num_patches);
  bool is_split = false;
  for (size_t label = 0; label < num_patches; ++label) {
    const size_t num = patch_heights[label].size();
    if (num < 2 * static_cast<size_t>(min_pixels)) continue;
    limits[label] = HeightsBetweenFaces(patch_heights[label],
                                        sigma_sums[label] / static_cast<float>(num), min_pixels);
    is_split |= !limits[label].empty();
  }
  if (!is_split) return;
  std::vector<uint8_t> mask(heights.size(), 0);
  std::vector<float> banded = heights;
  for (size_t i = 0; i < heights.size(); ++i) {
    if (patches->label[i] < 0) continue;
    mask[i] = 1;
    for (const float limit : limits[static_cast<size_t>(patches->label[i])]) {
      if (heights[i] > limit) banded[i] += kBandOffset;
    }
  }
  *patches = LabelComponents(columns, rows, mask, banded, max_step_m);
}

}  // namespace declutter
