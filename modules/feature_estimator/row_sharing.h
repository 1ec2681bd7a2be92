#pragma once

#include <cstddef>
#include <initializer_list>
#include <vector>

#include "modules/feature_estimator/sphere_window.h"

namespace declutter {

// Where windows are read at a stride, those of neighbouring points share nearly all of their
// samples: of every three rows of points, the outer ones take over what was found for the one in
// the middle.
struct RowOrder {
  static constexpr int kNumPasses = 2;

  // The rows of a pass: first those in the middle, then the others.
  static bool IsIn(int row, int pass) { return (row % 3 == 1) == (pass == 0); }
  // From a row of the second pass to the one that it takes over from.
  static int Source(int row) { return row % 3 == 0 ? 1 : -1; }
};

// Copies values from the row `source` rows further down, in each of the planes, for the points with
// an x below kFar in elements [begin, begin + PointImage::kLanes); 0 for the others. Does nothing
// and is false unless their windows are read at a stride and each point has another one just there.
bool TakeRow(const PointImage& points, const float* x, size_t begin, int source,
             const Neighborhood& neighborhood, std::initializer_list<std::vector<float>*> planes);

}  // namespace declutter
