#include "modules/geometry/image_components.h"

#include <cmath>
#include <utility>

#include "modules/geometry/marked_pixels.h"

namespace declutter {
namespace {

// Disjoint sets; the root of a set is its smallest element.
class DisjointSets {
 public:
  int32_t Add() {
    parent_.push_back(static_cast<int32_t>(parent_.size()));
    return parent_.back();
  }
  int32_t Root(int32_t i) {
    while (parent_[static_cast<size_t>(i)] != i) {
      parent_[static_cast<size_t>(i)] =
          parent_[static_cast<size_t>(parent_[static_cast<size_t>(i)])];
      i = parent_[static_cast<size_t>(i)];
    }
    return i;
  }
  void Join(int32_t i, int32_t j) {
    i = Root(i);
    j = Root(j);
    if (i > j) std::swap(i, j);
    parent_[static_cast<size_t>(j)] = i;
  }
  size_t size() const { return parent_.size(); }

 private:
  std::vector<int32_t> parent_;
};

// Replaces provisional labels by consecutive ones and counts their pixels.
void Renumber(const std::vector<uint8_t>& mask, DisjointSets* sets, ImageComponents* components) {
  std::vector<int32_t> number(sets->size(), -1);
  for (size_t i = 0; i < number.size(); ++i) {
    const size_t root = static_cast<size_t>(sets->Root(static_cast<int32_t>(i)));
    if (root == i) {
      number[i] = static_cast<int32_t>(components->num_pixels.size());
      components->num_pixels.push_back(0);
    } else {
      number[i] = number[root];
    }
  }
  int32_t* label = components->label.data();
  int32_t* num_pixels = components->num_pixels.data();
  ForEachMarked(mask.data(), 0, mask.size(), [&](size_t i) {
    label[i] = number[static_cast<size_t>(label[i])];
    ++num_pixels[label[i]];
  });
}

}  // namespace

ImageComponents LabelComponents(int width, int height, const std::vector<uint8_t>& mask,
                                const std::vector<float>& values, float max_step) {
  ImageComponents components;
  components.label.assign(mask.size(), -1);
  int32_t* label = components.label.data();
  DisjointSets sets;
  for (int v = 0; v < height; ++v) {
    const auto row = static_cast<size_t>(v) * static_cast<size_t>(width);
    ForEachMarked(mask.data(), row, row + static_cast<size_t>(width), [&](size_t p) {
      const auto i = static_cast<int>(p);
      const int u = static_cast<int>(p - row);
      const float value = values[p];
      const auto join = [&](int j) {
        // Mostly, the neighbours seen before have the same label already.
        if (label[j] < 0 || label[j] == label[i]) return;
        if (std::abs(values[static_cast<size_t>(j)] - value) > max_step) return;
        if (label[i] < 0) {
          label[i] = label[j];
        } else {
          sets.Join(label[i], label[j]);
        }
      };
      if (u > 0) join(i - 1);
      if (v > 0) join(i - width);
      if (v > 0 && u > 0) join(i - width - 1);
      if (v > 0 && u + 1 < width) join(i - width + 1);
      if (label[i] < 0) label[i] = sets.Add();
    });
  }
  Renumber(mask, &sets, &components);
  return components;
}

}  // namespace declutter
