#pragma once

#include <optional>
#include <vector>

#include "modules/geometry/solid.h"
#include "tests/accuracy/scene_truth.h"

namespace declutter::accuracy {

// Pixels that models and true objects have, and share; all counts in px.
struct PixelOverlap {
  bool has_labels = false;                  // whether the truth has a label image
  std::vector<int> model_px;                // of each model
  std::vector<int> object_px;               // of each true object
  std::vector<std::vector<int>> shared_px;  // [model][object]

  double Iou(size_t model, size_t object) const;
  // Pixels of the model on no object.
  int NumStray(size_t model) const;
  // The object that has most of the model's pixels, when any has one.
  std::optional<size_t> MainObject(size_t model) const;
};
PixelOverlap MeasureOverlap(const SceneTruth& truth, const ObjectList& found);

// Indices, row * width + column, of the pixels of each true object in the label image.
std::vector<std::vector<int>> PixelsOfObjects(const SceneTruth& truth);

// Index of the model whose pixel is nearest to seed_px, within max_distance_px.
std::optional<size_t> ModelAt(const ObjectList& found, const Eigen::Vector2i& seed_px,
                              int max_distance_px);

}  // namespace declutter::accuracy
