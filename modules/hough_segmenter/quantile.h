#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace declutter {

// Value below which `fraction` of the values lie; values must not be empty. Changes their order.
inline float Quantile(std::vector<float>* values, double fraction) {
  const auto rank = static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values->size() - 1));
  std::nth_element(values->begin(), values->begin() + rank, values->end());
  return (*values)[static_cast<size_t>(rank)];
}

}  // namespace declutter
