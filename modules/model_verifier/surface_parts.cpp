#include "modules/model_verifier/surface_parts.h"

#include <algorithm>
#include <cmath>

namespace declutter {
namespace {

constexpr float kMaxTopStep = 0.006f;    // [m] in height between neighbours on one top face
constexpr float kMaxSideStep = 0.012f;   // [m] in depth between neighbours on one side
constexpr int kMaxGap = 3;               // pixels of the grid without depth beside an edge
constexpr float kMinTopNormal = 0.90f;   // upward, of a normal on a top face
constexpr float kMaxSideNormal = 0.50f;  // upward, of a normal on a side

constexpr int32_t kMarked = -2;

}  // namespace

const SurfaceParts& PartFinder::Find(const std::vector<uint8_t>& is_marked,
                                     const PixelWindow& window, const Eigen::Isometry3d& X_TC,
                                     size_t min_points, const Observation& observation) {
  const Input input{is_marked, observation, window, X_TC.cast<float>()};
  columns_ = window.u_end - window.u_begin;
  rows_ = window.v_end - window.v_begin;
  pixels_.assign(static_cast<size_t>(columns_ * rows_), Pixel());
  labels_.Clear();
  for (int v = 0; v < rows_; ++v) {
    for (int u = 0; u < columns_; ++u) {
      Measure(u, v, input);
      if (pixels_[Index(u, v)].label == kMarked) Join(u, v);
    }
  }
  GrowTopsOverRims();
  GatherParts(input);
  DropSmall(min_points);
  return parts_;
}

void PartFinder::GatherParts(const Input& input) {
  parts_.Clear();
  for (size_t i = 0; i < labels_.size(); ++i) {
    SurfacePart& part = parts_.Add();
    part.tops.clear();
    part.sides.clear();
    part.outline.clear();
  }
  for (int v = 0; v < rows_; ++v) {
    for (int u = 0; u < columns_; ++u) {
      const Pixel& pixel = pixels_[Index(u, v)];
      if (pixel.label < 0) continue;
      SurfacePart& part = parts_[labels_.Root(pixel.label)];
      (pixel.is_top() ? part.tops : part.sides).push_back(pixel.p_T);
      if (!pixel.is_top() || IsFreeEdge(u, v, input)) {
        part.outline.push_back(pixel.p_T.head<2>());
      }
    }
  }
}

void PartFinder::DropSmall(size_t min_points) {
  size_t num = 0;
  for (size_t i = 0; i < parts_.size(); ++i) {
    if (parts_[i].num_points() < min_points) continue;
    if (num != i) std::swap(parts_[num], parts_[i]);
    ++num;
  }
  while (parts_.size() > num) parts_.RemoveLast();
}

Eigen::Vector3f PartFinder::PointAt(int u, int v, const Input& input) const {
  const PixelGrid& grid = input.observation.grid;
  return input.X_TC *
         (pixels_[Index(u, v)].depth *
          Eigen::Vector3f(grid.ray_x[static_cast<size_t>(u + input.window.u_begin)],
                          grid.ray_y[static_cast<size_t>(v + input.window.v_begin)], 1));
}

void PartFinder::Measure(int u, int v, const Input& input) {
  const PixelGrid& grid = input.observation.grid;
  const auto column = static_cast<size_t>(u + input.window.u_begin);
  const auto row = static_cast<size_t>(v + input.window.v_begin);
  Pixel& pixel = pixels_[Index(u, v)];
  pixel.depth = grid.z[row * grid.stride + column];
  if (!input.is_marked[row * static_cast<size_t>(grid.columns) + column]) return;
  pixel.label = kMarked;
  pixel.p_T = PointAt(u, v, input);
  const Eigen::Vector3f n_C = input.observation.normals.At(static_cast<int>(column) * grid.step,
                                                           static_cast<int>(row) * grid.step);
  const float up = input.X_TC.linear().row(2).dot(n_C);
  if (up > kMinTopNormal) pixel.kind = FaceKind::kTop;
  if (up < kMaxSideNormal && !n_C.isZero()) pixel.kind = FaceKind::kSide;
}

// Joins a pixel to the part of the one above it or left of it. What is below a top face in the
// image is its front side: sides are parted where the tops above them are.
void PartFinder::Join(int u, int v) {
  Pixel& pixel = pixels_[Index(u, v)];
  pixel.label = -1;
  const int32_t above = v > 0 ? LabelIfJoined(pixel, pixels_[Index(u, v - 1)], true) : -1;
  const int32_t left = u > 0 ? LabelIfJoined(pixel, pixels_[Index(u - 1, v)], false) : -1;
  if (above < 0 && left < 0) {
    pixel.label = labels_.New(pixel.kind);
    return;
  }
  pixel.label = above >= 0 ? above : left;
  labels_.Raise(pixel.label, pixel.kind);
  if (above >= 0 && left >= 0 && AreOnePart(pixel, above, left)) labels_.Join(above, left);
}

// The label of a neighbour when it goes on in a pixel, or -1.
int32_t PartFinder::LabelIfJoined(const Pixel& pixel, const Pixel& other, bool is_above) {
  if (other.label < 0) return -1;
  bool is_joined = false;
  if (pixel.is_top()) {
    is_joined = (other.is_top() || labels_.KindOf(other.label) == FaceKind::kVague) &&
                std::abs(other.p_T.z() - pixel.p_T.z()) < kMaxTopStep;
  } else {
    is_joined = (is_above || !other.is_top()) && std::abs(other.depth - pixel.depth) < kMaxSideStep;
  }
  return is_joined ? other.label : -1;
}

// True when a pixel at which two parts meet is no border between them.
bool PartFinder::AreOnePart(const Pixel& pixel, int32_t a, int32_t b) {
  const FaceKind first = labels_.KindOf(a), second = labels_.KindOf(b);
  return pixel.is_top() || std::min(first, second) == FaceKind::kVague ||
         std::max(first, second) == FaceKind::kSide;
}

// Takes points whose normals are blurred and that are as high as the top of their part for parts
// of that.
void PartFinder::GrowTopsOverRims() {
  sums_.assign(labels_.size(), Eigen::Vector2f::Zero());
  for (const Pixel& pixel : pixels_) {
    if (pixel.label < 0 || !pixel.is_top()) continue;
    sums_[labels_.Root(pixel.label)] += Eigen::Vector2f(pixel.p_T.z(), 1);
  }
  for (Pixel& pixel : pixels_) {
    if (pixel.label < 0 || pixel.kind != FaceKind::kVague) continue;
    const Eigen::Vector2f& sum = sums_[labels_.Root(pixel.label)];
    if (std::abs(pixel.p_T.z() * sum.y() - sum.x()) < kMaxTopStep * sum.y()) {
      pixel.kind = FaceKind::kTop;
    }
  }
}

// True when the first that is seen beside a pixel of a top face is lower: the face ends there.
bool PartFinder::IsFreeEdge(int u, int v, const Input& input) const {
  return IsFree(u, v, 1, 0, input) || IsFree(u, v, -1, 0, input) || IsFree(u, v, 0, 1, input) ||
         IsFree(u, v, 0, -1, input);
}

bool PartFinder::IsFree(int u, int v, int du, int dv, const Input& input) const {
  const Pixel& pixel = pixels_[Index(u, v)];
  for (int step = 1; step <= kMaxGap; ++step) {
    const int x = u + step * du, y = v + step * dv;
    if (x < 0 || y < 0 || x >= columns_ || y >= rows_) return false;
    const Pixel& other = pixels_[Index(x, y)];
    if (other.depth <= 0) continue;
    return PointAt(x, y, input).z() < pixel.p_T.z() - kMaxTopStep;
  }
  return false;
}

}  // namespace declutter
