#include "modules/plane_filter/independent_noise.h"

#include <cmath>
#include <cstddef>

#include "modules/geometry/quantile.h"

namespace declutter {

double IndependentNoise(const InverseDepth& image, std::vector<float>* buffer) {
  constexpr int kRowStep = 8, kColumnStep = 4;
  constexpr size_t kMinNum = 50;
  // Of a normal deviate, the median of its absolute value; and of one with coefficients 1, -2, 1.
  constexpr double kMedianOfSigma = 0.6745;
  const double sigma_of_difference = std::sqrt(6.0);
  std::vector<float>& differences = *buffer;
  differences.clear();
  for (int v = kRowStep / 2; v < image.height; v += kRowStep) {
    const float* row = &image.values[image.Index(0, v)];
    for (int u = 1; u + 1 < image.width; u += kColumnStep) {
      if (row[u - 1] <= 0 || row[u] <= 0 || row[u + 1] <= 0) continue;
      differences.push_back(std::abs(row[u - 1] - 2 * row[u] + row[u + 1]));
    }
  }
  if (differences.size() < kMinNum) return 0;
  return Quantile(&differences, 0.5f) / (kMedianOfSigma * sigma_of_difference);
}

}  // namespace declutter
