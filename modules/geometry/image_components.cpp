#include "modules/geometry/image_components.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "modules/geometry/marked_pixels.h"

namespace declutter {
namespace {

// Pixels of one row, each connected with the next one: elements begin .. end - 1.
struct Run {
  size_t begin, end;
};

// Disjoint sets; the root of a set is its smallest element.
class DisjointSets {
 public:
  explicit DisjointSets(size_t size) {
    for (size_t i = 0; i < size; ++i) parent_.push_back(i);
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
  std::vector<size_t> parent_;
};

// The marked pixels of an image, cut into runs, and the first run of each row.
struct Rows {
  std::vector<Run> runs;
  std::vector<size_t> first_run;
};

Rows FindRuns(size_t width, size_t height, const std::vector<uint8_t>& mask,
              const std::vector<float>& values, float max_step) {
  Rows rows;
  for (size_t v = 0; v < height; ++v) {
    rows.first_run.push_back(rows.runs.size());
    size_t end = 0;  // of the last run
    ForEachMarked(mask.data(), v * width, (v + 1) * width, [&](size_t p) {
      if (p == end && p > v * width && std::abs(values[p] - values[p - 1]) <= max_step) {
        rows.runs.back().end = p + 1;
      } else {
        rows.runs.push_back({p, p + 1});
      }
      end = p + 1;
    });
  }
  rows.first_run.push_back(rows.runs.size());
  return rows;
}

// True when a pixel of a run connects with one of the run `above`, in the row before it.
bool Touch(const Run& above, const Run& run, size_t width, const std::vector<float>& values,
           float max_step) {
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

ImageComponents LabelComponents(int width, int height, const std::vector<uint8_t>& mask,
                                const std::vector<float>& values, float max_step) {
  const auto columns = static_cast<size_t>(width);
  const Rows rows = FindRuns(columns, static_cast<size_t>(height), mask, values, max_step);
  DisjointSets sets(rows.runs.size());
  for (size_t v = 1; v < static_cast<size_t>(height); ++v) {
    size_t first = rows.first_run[v - 1];
    for (size_t i = rows.first_run[v]; i < rows.first_run[v + 1]; ++i) {
      const Run& run = rows.runs[i];
      while (first < rows.first_run[v] && rows.runs[first].end + columns < run.begin) ++first;
      for (size_t j = first; j < rows.first_run[v] && rows.runs[j].begin + columns <= run.end;
           ++j) {
        if (sets.Root(i) != sets.Root(j) && Touch(rows.runs[j], run, columns, values, max_step)) {
          sets.Join(i, j);
        }
      }
    }
  }

  ImageComponents components;
  components.label.assign(mask.size(), -1);
  std::vector<int32_t> number(rows.runs.size());
  for (size_t i = 0; i < rows.runs.size(); ++i) {
    const size_t root = sets.Root(i);
    if (root == i) {
      number[i] = static_cast<int32_t>(components.num_pixels.size());
      components.num_pixels.push_back(0);
    }
    number[i] = number[root];
    const Run& run = rows.runs[i];
    components.num_pixels[static_cast<size_t>(number[i])] +=
        static_cast<int32_t>(run.end - run.begin);
    std::fill(components.label.begin() + static_cast<std::ptrdiff_t>(run.begin),
              components.label.begin() + static_cast<std::ptrdiff_t>(run.end), number[i]);
  }
  return components;
}

}  // namespace declutter
