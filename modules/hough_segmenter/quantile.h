#pragma once

#include <vector>

#include "modules/hough_segmenter/cell_kernels.h"

namespace declutter {

// The values below which the two fractions of the values lie; values must not be empty. Uses room
// behind them meanwhile.
Range Quantiles(std::vector<float>* values, double low_fraction, double high_fraction);

inline float Quantile(std::vector<float>* values, double fraction) {
  return Quantiles(values, fraction, fraction).low;
}

}  // namespace declutter
