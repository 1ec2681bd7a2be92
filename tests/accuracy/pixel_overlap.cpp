#include "tests/accuracy/pixel_overlap.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>

namespace declutter::accuracy {
namespace {

constexpr size_t kNone = 256;

// Index for each value of a label image, kNone for values of nobody.
using IndexByValue = std::array<size_t, 256>;

IndexByValue IndexObjects(const std::vector<TrueObject>& objects) {
  IndexByValue index;
  index.fill(kNone);
  for (size_t i = 0; i < objects.size(); ++i) {
    for (const int label : objects[i].labels) index.at(static_cast<size_t>(label)) = i;
  }
  return index;
}

IndexByValue IndexModels(const std::vector<ObjectModel>& models) {
  IndexByValue index;
  index.fill(kNone);
  for (size_t i = 0; i < models.size(); ++i) index.at(static_cast<size_t>(models[i].id)) = i;
  return index;
}

}  // namespace

double PixelOverlap::Iou(size_t model, size_t object) const {
  const int shared = shared_px[model][object];
  const int all = model_px[model] + object_px[object] - shared;
  return all > 0 ? static_cast<double>(shared) / all : 0.0;
}

int PixelOverlap::NumStray(size_t model) const {
  const auto& shared = shared_px[model];
  return model_px[model] - std::accumulate(shared.begin(), shared.end(), 0);
}

std::optional<size_t> PixelOverlap::MainObject(size_t model) const {
  const auto& shared = shared_px[model];
  const auto most = std::max_element(shared.begin(), shared.end());
  if (most == shared.end() || *most == 0) return std::nullopt;
  return static_cast<size_t>(most - shared.begin());
}

PixelOverlap MeasureOverlap(const SceneTruth& truth, const ObjectList& found) {
  PixelOverlap overlap;
  overlap.has_labels = !truth.labels.empty();
  overlap.model_px.assign(found.objects.size(), 0);
  overlap.object_px.assign(truth.objects.size(), 0);
  overlap.shared_px.assign(found.objects.size(), std::vector<int>(truth.objects.size(), 0));
  const bool models_have_pixels = !found.labels.empty();
  if (overlap.has_labels && models_have_pixels && truth.labels.size() != found.labels.size()) {
    throw std::runtime_error("label images of truth and models differ in size");
  }
  const IndexByValue object_of = IndexObjects(truth.objects);
  const IndexByValue model_of = IndexModels(found.objects);
  for (size_t i = 0; i < std::max(truth.labels.size(), found.labels.size()); ++i) {
    const size_t object = overlap.has_labels ? object_of[truth.labels[i]] : kNone;
    const size_t model = models_have_pixels ? model_of[found.labels[i]] : kNone;
    if (object != kNone) ++overlap.object_px[object];
    if (model != kNone) ++overlap.model_px[model];
    if (object != kNone && model != kNone) ++overlap.shared_px[model][object];
  }
  return overlap;
}

std::vector<std::vector<int>> PixelsOfObjects(const SceneTruth& truth) {
  std::vector<std::vector<int>> pixels(truth.objects.size());
  const IndexByValue object_of = IndexObjects(truth.objects);
  for (size_t i = 0; i < truth.labels.size(); ++i) {
    const size_t object = object_of[truth.labels[i]];
    if (object != kNone) pixels[object].push_back(static_cast<int>(i));
  }
  return pixels;
}

std::optional<size_t> ModelAt(const ObjectList& found, const Eigen::Vector2i& seed_px,
                              int max_distance_px) {
  if (found.labels.empty()) return std::nullopt;
  const IndexByValue model_of = IndexModels(found.objects);
  const int width = found.camera.width;
  const int height = found.camera.height;
  int best_squared = max_distance_px * max_distance_px + 1;
  size_t best = kNone;
  for (int dv = -max_distance_px; dv <= max_distance_px; ++dv) {
    for (int du = -max_distance_px; du <= max_distance_px; ++du) {
      const int u = seed_px.x() + du;
      const int v = seed_px.y() + dv;
      if (u < 0 || v < 0 || u >= width || v >= height) continue;
      const size_t model = model_of[found.labels[static_cast<size_t>(v * width + u)]];
      if (model == kNone || du * du + dv * dv >= best_squared) continue;
      best_squared = du * du + dv * dv;
      best = model;
    }
  }
  if (best == kNone) return std::nullopt;
  return best;
}

}  // namespace declutter::accuracy
