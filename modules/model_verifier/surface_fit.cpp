#include "modules/model_verifier/surface_fit.h"

#include <algorithm>
#include <cmath>

namespace declutter {

double Weight(const FitPoint& point, double cosine) {
  const double sigma = point.sigma * std::max(std::abs(cosine), 0.5);
  return 1 / (sigma * sigma);
}

}  // namespace declutter
