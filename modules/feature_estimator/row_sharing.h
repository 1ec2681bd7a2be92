#pragma once

#include <cstddef>
#include <initializer_list>
#include <vector>

#include "modules/feature_estimator/sphere_window.h"

namespace declutter {

// Where windows are read at a stride, those of neighbouring points share nearly all of their
// samples: every other row of points takes over what was found for the row above.
//
// Copies values of the row above, in each of the planes, for the points with an x below kFar in
// elements [begin, begin + PointImage::kLanes); 0 for the others. Does nothing and is false unless
// their windows are read at a stride and each point has another one just above it.
bool TakeRowAbove(const PointImage& points, const float* x, size_t begin,
                  const Neighborhood& neighborhood,
                  std::initializer_list<std::vector<float>*> planes);

}  // namespace declutter
