#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "modules/geometry/disjoint_sets.h"

namespace declutter {

// Pixels begin .. end - 1 of one row, all of one component.
struct ComponentRun {
  size_t begin = 0, end = 0;
  int32_t component = -1;
};

// Connected components of the marked pixels of an image, numbered in row-major order of their first
// pixels.
struct ComponentRuns {
  std::vector<ComponentRun> runs;   // of all marked pixels, in row-major order
  std::vector<int32_t> num_pixels;  // per component

  std::vector<size_t> first_run;  // of each row, and how many there are

  // What finding them needs meanwhile: the set of each run, named by its first one, and where runs
  // go on and begin or end in a row.
  DisjointSets sets;
  std::vector<uint8_t> joined, edges;
};

// Joins marked pixels (1, the others 0) that touch (8 neighbours) and whose values differ by at
// most max_step. mask and values are row-major, width * height long. `recycled` gives its memory to
// the result.
ComponentRuns FindComponents(int width, int height, const std::vector<uint8_t>& mask,
                             const std::vector<float>& values, float max_step,
                             ComponentRuns recycled = {});

}  // namespace declutter
