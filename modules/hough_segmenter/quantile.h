#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "modules/hough_segmenter/cell_kernels.h"

namespace declutter {

// The values below which the two fractions of the values lie; values must not be empty. Changes
// their order. A histogram tells which few values come into question, so that hardly a branch
// depends on data.
inline Range Quantiles(std::vector<float>* values, double low_fraction, double high_fraction) {
  constexpr size_t kNumBins = 256;
  const Range range = RangeOf(values->data(), values->size());
  if (!(range.high > range.low)) return range;
  const float bins_per_unit = (static_cast<float>(kNumBins) - 0.5f) / (range.high - range.low);
  const auto bin_of = [&](float value) {
    return static_cast<size_t>((value - range.low) * bins_per_unit);
  };
  std::array<uint32_t, kNumBins> num_in_bin{};
  for (const float value : *values) ++num_in_bin[bin_of(value)];
  const auto value_at = [&](double fraction) {
    auto rank = static_cast<size_t>(fraction * static_cast<double>(values->size() - 1));
    size_t bin = 0;
    while (rank >= num_in_bin[bin]) rank -= num_in_bin[bin++];
    size_t num_chosen = 0;
    for (float& value : *values) {
      if (bin_of(value) == bin) std::swap(value, (*values)[num_chosen++]);
    }
    const auto begin = values->begin();
    const auto nth = begin + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(begin, nth, begin + static_cast<std::ptrdiff_t>(num_chosen));
    return *nth;
  };
  const float low = value_at(low_fraction);
  return {low, high_fraction == low_fraction ? low : value_at(high_fraction)};
}

inline float Quantile(std::vector<float>* values, double fraction) {
  return Quantiles(values, fraction, fraction).low;
}

}  // namespace declutter
