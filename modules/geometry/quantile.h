#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace declutter {

// The value below which a share of the values lies, in [0, 1]; values must not be empty, and change
// places.
template <typename Real>
Real Quantile(std::vector<Real>* values, Real share) {
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<Real>(values->size() - 1) +
                                                static_cast<Real>(0.5));
  std::nth_element(values->begin(), values->begin() + rank, values->end());
  return (*values)[static_cast<size_t>(rank)];
}

}  // namespace declutter
