#include "modules/geometry/image_components.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "modules/geometry/marked_pixels.h"

namespace declutter {
namespace {

// Disjoint sets, in given memory; the root of a set is its smallest element.
class DisjointSets {
 public:
  DisjointSets(size_t size, std::vector<size_t>* parent) : parent_(*parent) {
    parent_.resize(size);
    for (size_t i = 0; i < size; ++i) parent_[i] = i;
  }
  size_t Root(size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void Join(size_t i, size_t j) {
    i = Root(i);
    j = Root(j);
    if (i > j) std::swap(i, j);
    parent_[j] = i;
  }

 private:
  std::vector<size_t>& parent_;
};

// Cuts the marked pixels into runs, each pixel of which is connected with the next one.
void FindRuns(size_t width, size_t height, const std::vector<uint8_t>& mask,
              const std::vector<float>& values, float max_step, ComponentRuns* rows) {
  rows->runs.clear();
  rows->first_run.clear();
  for (size_t v = 0; v < height; ++v) {
    rows->first_run.push_back(rows->runs.size());
    size_t end = 0;  // of the last run
    ForEachMarked(mask.data(), v * width, (v + 1) * width, [&](size_t p) {
      if (p == end && p > v * width && std::abs(values[p] - values[p - 1]) <= max_step) {
        rows->runs.back().end = p + 1;
      } else {
        rows->runs.push_back({p, p + 1});
      }
      end = p + 1;
    });
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
  DisjointSets sets(runs.size(), &components.parent);
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

ImageComponents LabelComponents(int width, int height, const std::vector<uint8_t>& mask,
                                const std::vector<float>& values, float max_step) {
  ComponentRuns found = FindComponents(width, height, mask, values, max_step);
  ImageComponents components{std::vector<int32_t>(mask.size(), -1), std::move(found.num_pixels)};
  for (const ComponentRun& run : found.runs) {
    std::fill(components.label.begin() + static_cast<std::ptrdiff_t>(run.begin),
              components.label.begin() + static_cast<std::ptrdiff_t>(run.end), run.component);
  }
  return components;
}

}  // namespace declutter
