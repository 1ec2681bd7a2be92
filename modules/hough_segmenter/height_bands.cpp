#include "modules/hough_segmenter/height_bands.h"

#include <algorithm>
#include <cmath>

#include "modules/hough_segmenter/quantile.h"

namespace declutter {
namespace {

constexpr float kBin = 0.0005f;       // [m] of the distribution of heights
constexpr float kValley = 0.5f;       // of the peak on either side
constexpr int kWindow = 5;            // [px] over which noise is averaged
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

// Means over the pixels of the same patch in a window, first along rows, then along columns; pixels
// are those of all patches.
std::vector<float> SmoothWithin(const ImageComponents& patches, const std::vector<size_t>& pixels,
                                const std::vector<float>& values, int columns, int rows) {
  constexpr int kReach = kWindow / 2;
  const auto along = [&](const std::vector<float>& in, int length, int stride) {
    std::vector<float> out(in.size(), 0);
    for (const size_t i : pixels) {
      const int at = static_cast<int>(i) / stride % length;
      float sum = 0;
      int num = 0;
      for (int k = -std::min(kReach, at); k <= std::min(kReach, length - 1 - at); ++k) {
        const auto j = static_cast<size_t>(static_cast<int>(i) + k * stride);
        if (patches.label[j] != patches.label[i]) continue;
        sum += in[j];
        ++num;
      }
      out[i] = sum / static_cast<float>(num);
    }
    return out;
  };
  return along(along(values, columns, 1), rows, columns);
}

// Standard deviation of values of which the absolute differences of pairs are given.
float SigmaOf(std::vector<float>* differences) {
  constexpr float kSigmaOfMedian = 1.4826f / 1.4142f;
  return std::max(kBin, kSigmaOfMedian * Quantile(differences, 0.5));
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

void SplitAtHeights(int columns, int rows, const std::vector<float>& heights, float max_step_m,
                    int min_pixels, ImageComponents* patches) {
  std::vector<size_t> pixels;
  for (size_t i = 0; i < heights.size(); ++i) {
    if (patches->label[i] >= 0) pixels.push_back(i);
  }
  const std::vector<float> smooth = SmoothWithin(*patches, pixels, heights, columns, rows);
  const size_t num_patches = patches->num_pixels.size();
  std::vector<std::vector<float>> patch_heights(num_patches);
  std::vector<std::vector<float>> differences(num_patches);
  for (const size_t i : pixels) {
    const auto label = static_cast<size_t>(patches->label[i]);
    patch_heights[label].push_back(smooth[i]);
    if (i >= kWindow && patches->label[i - kWindow] == patches->label[i]) {
      differences[label].push_back(std::abs(smooth[i] - smooth[i - kWindow]));
    }
  }
  std::vector<std::vector<float>> limits(num_patches);
  bool is_split = false;
  for (size_t label = 0; label < num_patches; ++label) {
    if (patch_heights[label].size() < 2 * static_cast<size_t>(min_pixels) ||
        differences[label].empty()) {
      continue;
    }
    limits[label] =
        HeightsBetweenFaces(patch_heights[label], SigmaOf(&differences[label]), min_pixels);
    is_split |= !limits[label].empty();
  }
  if (!is_split) return;
  std::vector<uint8_t> mask(heights.size(), 0);
  std::vector<float> banded = smooth;
  for (const size_t i : pixels) {
    mask[i] = 1;
    for (const float limit : limits[static_cast<size_t>(patches->label[i])]) {
      if (smooth[i] > limit) banded[i] += kBandOffset;
    }
  }
  *patches = LabelComponents(columns, rows, mask, banded, max_step_m);
}

}  // namespace declutter
