#include "modules/geometry/image_components.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "modules/geometry/for_each_processor.h"
#include "modules/geometry/pixel_runs.h"

namespace declutter {
namespace {

// Marks in joined[1 .. num - 1] the pixels of a row that are connected with the one before, and in
// edges those that a run begins or ends with.
DECLUTTER_FOR_EACH_PROCESSOR void MarkEdges(const uint8_t* mask, const float* values, size_t num,
                                            float max_step, uint8_t* joined, uint8_t* edges) {
  for (size_t i = 1; i < num; ++i) {
    const uint8_t is_near = std::abs(values[i] - values[i - 1]) <= max_step;
    joined[i] = mask[i] & mask[i - 1] & is_near;
  }
  for (size_t i = 0; i < num; ++i) {
    edges[i] = RunEdges(mask[i] > 0, joined[i], joined[i + 1]);
  }
}

// Cuts the marked pixels into runs, each pixel of which is connected with the next one.
void FindRuns(size_t width, size_t height, const std::vector<uint8_t>& mask,
              const std::vector<float>& values, float max_step, ComponentRuns* rows) {
  rows->runs.clear();
  rows->first_run.clear();
  rows->joined.assign(width + 1, 0);
  rows->edges.resize(width);
  for (size_t row = 0; row < width * height; row += width) {
    rows->first_run.push_back(rows->runs.size());
    MarkEdges(&mask[row], &values[row], width, max_step, rows->joined.data(), rows->edges.data());
    AppendRuns(rows->edges, row, &rows->runs);
  }
  rows->first_run.push_back(rows->runs.size());
}

// True when a pixel of a run connects with one of the run `above`, in the row before it.
bool Touch(const ComponentRun& above, const ComponentRun& run, size_t width,
           const std::vector<float>& values, float max_step) {
  const size_t begin = std::max(run.begin, above.begin + width - 1);
  const size_t end = std::min(run.end, above.end + width + 1);
  for (size_t p = begin; p < end; ++p) {
    const size_t last = std::min(p - width + 2, above.end);
    for (size_t q = std::max(p - width, above.begin + 1) - 1; q < last; ++q) {
      if (std::abs(values[q] - values[p]) <= max_step) return true;
    }
  }
  return false;
}

}  // namespace

ComponentRuns FindComponents(int width, int height, const std::vector<uint8_t>& mask,
                             const std::vector<float>& values, float max_step,
                             ComponentRuns recycled) {
  ComponentRuns components = std::move(recycled);
  const auto columns = static_cast<size_t>(width);
  FindRuns(columns, static_cast<size_t>(height), mask, values, max_step, &components);
  std::vector<ComponentRun>& runs = components.runs;
  const std::vector<size_t>& first_run = components.first_run;
  DisjointSets& sets = components.sets;
  sets.Reset(runs.size());
  for (size_t v = 1; v < static_cast<size_t>(height); ++v) {
    size_t first = first_run[v - 1];
    for (size_t i = first_run[v]; i < first_run[v + 1]; ++i) {
      const ComponentRun& run = runs[i];
      while (first < first_run[v] && runs[first].end + columns < run.begin) ++first;
      for (size_t j = first; j < first_run[v] && runs[j].begin + columns <= run.end; ++j) {
        if (sets.Root(i) != sets.Root(j) && Touch(runs[j], run, columns, values, max_step)) {
          sets.Join(i, j);
        }
      }
    }
  }

  components.num_pixels.clear();
  for (size_t i = 0; i < runs.size(); ++i) {
    const size_t root = sets.Root(i);
    if (root == i) {
      runs[i].component = static_cast<int32_t>(components.num_pixels.size());
      components.num_pixels.push_back(0);
    }
    runs[i].component = runs[root].component;
    components.num_pixels[static_cast<size_t>(runs[i].component)] +=
        static_cast<int32_t>(runs[i].end - runs[i].begin);
  }
  return components;
}

}  // namespace declutter
