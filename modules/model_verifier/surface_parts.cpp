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

// What the normal at a point tells of the face it is on, or the most telling one of a part. Around
// edges it is blurred, or there is none.
enum class FaceKind : int8_t { kVague, kSide, kTop };

// Parts of which some turn out to be the same.
class Labels {
 public:
  int32_t New(FaceKind kind) {
    parent_.push_back(static_cast<int32_t>(parent_.size()));
    kind_.push_back(kind);
    return parent_.back();
  }
  int32_t Root(int32_t label) {
    int32_t& parent = parent_[static_cast<size_t>(label)];
    if (parent != label) parent = Root(parent);
    return parent;
  }
  FaceKind KindOf(int32_t label) { return kind_[static_cast<size_t>(Root(label))]; }
  void Raise(int32_t label, FaceKind kind) {
    FaceKind& known = kind_[static_cast<size_t>(Root(label))];
    known = std::max(known, kind);
  }
  void Join(int32_t a, int32_t b) {
    const int32_t x = Root(a), y = Root(b);
    const FaceKind kind = std::max(KindOf(a), KindOf(b));
    parent_[static_cast<size_t>(std::max(x, y))] = std::min(x, y);
    Raise(a, kind);
  }
  size_t size() const { return parent_.size(); }

 private:
  std::vector<int32_t> parent_;
  std::vector<FaceKind> kind_;
};

struct Pixel {
  Eigen::Vector3f p_T = Eigen::Vector3f::Zero();
  float depth = 0;  // [m], 0: not measured
  FaceKind kind = FaceKind::kVague;
  int32_t label = -1;  // -1: not marked

  bool is_top() const { return kind == FaceKind::kTop; }
};

class PartFinder {
 public:
  PartFinder(const PixelWindow& window, const Eigen::Isometry3d& X_TC,
             const Observation& observation)
      : window_(window),
        X_TC_(X_TC.cast<float>()),
        observation_(observation),
        columns_(window.u_end - window.u_begin),
        rows_(window.v_end - window.v_begin),
        pixels_(static_cast<size_t>(columns_ * rows_)) {}

  std::vector<SurfacePart> Find(const std::vector<uint8_t>& is_marked) {
    for (int v = 0; v < rows_; ++v) {
      for (int u = 0; u < columns_; ++u) {
        Measure(u, v, is_marked);
        if (pixels_[Index(u, v)].label == kMarked) Join(u, v);
      }
    }
    GrowTopsOverRims();
    std::vector<SurfacePart> parts(labels_.size());
    for (int v = 0; v < rows_; ++v) {
      for (int u = 0; u < columns_; ++u) {
        const Pixel& pixel = pixels_[Index(u, v)];
        if (pixel.label < 0) continue;
        SurfacePart& part = parts[static_cast<size_t>(labels_.Root(pixel.label))];
        (pixel.is_top() ? part.tops : part.sides).push_back(pixel.p_T);
        if (!pixel.is_top() || IsFreeEdge(u, v)) part.outline.push_back(pixel.p_T.head<2>());
      }
    }
    return parts;
  }

 private:
  static constexpr int32_t kMarked = -2;

  size_t Index(int u, int v) const { return static_cast<size_t>(v * columns_ + u); }

  Eigen::Vector3f PointAt(int u, int v) const {
    const PixelGrid& grid = observation_.grid;
    return X_TC_ * (pixels_[Index(u, v)].depth *
                    Eigen::Vector3f(grid.ray_x[static_cast<size_t>(u + window_.u_begin)],
                                    grid.ray_y[static_cast<size_t>(v + window_.v_begin)], 1));
  }

  void Measure(int u, int v, const std::vector<uint8_t>& is_marked) {
    const PixelGrid& grid = observation_.grid;
    const auto column = static_cast<size_t>(u + window_.u_begin);
    const auto row = static_cast<size_t>(v + window_.v_begin);
    Pixel& pixel = pixels_[Index(u, v)];
    pixel.depth = grid.z[row * grid.stride + column];
    if (!is_marked[row * static_cast<size_t>(grid.columns) + column]) return;
    pixel.label = kMarked;
    pixel.p_T = PointAt(u, v);
    const Eigen::Vector3f n_C = observation_.normals.At(static_cast<int>(column) * grid.step,
                                                        static_cast<int>(row) * grid.step);
    const float up = X_TC_.linear().row(2).dot(n_C);
    if (up > kMinTopNormal) pixel.kind = FaceKind::kTop;
    if (up < kMaxSideNormal && !n_C.isZero()) pixel.kind = FaceKind::kSide;
  }

  // Joins a pixel to the part of the one above it or left of it. What is below a top face in the
  // image is its front side: sides are parted where the tops above them are.
  void Join(int u, int v) {
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
  int32_t LabelIfJoined(const Pixel& pixel, const Pixel& other, bool is_above) {
    if (other.label < 0) return -1;
    bool is_joined = false;
    if (pixel.is_top()) {
      is_joined = (other.is_top() || labels_.KindOf(other.label) == FaceKind::kVague) &&
                  std::abs(other.p_T.z() - pixel.p_T.z()) < kMaxTopStep;
    } else {
      is_joined =
          (is_above || !other.is_top()) && std::abs(other.depth - pixel.depth) < kMaxSideStep;
    }
    return is_joined ? other.label : -1;
  }

  // True when a pixel at which two parts meet is no border between them.
  bool AreOnePart(const Pixel& pixel, int32_t a, int32_t b) {
    const FaceKind first = labels_.KindOf(a), second = labels_.KindOf(b);
    return pixel.is_top() || std::min(first, second) == FaceKind::kVague ||
           std::max(first, second) == FaceKind::kSide;
  }

  // Takes points whose normals are blurred and that are as high as the top of their part for parts
  // of that.
  void GrowTopsOverRims() {
    std::vector<Eigen::Vector2f> sums(labels_.size(), Eigen::Vector2f::Zero());  // height, 1
    for (const Pixel& pixel : pixels_) {
      if (pixel.label < 0 || !pixel.is_top()) continue;
      sums[static_cast<size_t>(labels_.Root(pixel.label))] += Eigen::Vector2f(pixel.p_T.z(), 1);
    }
    for (Pixel& pixel : pixels_) {
      if (pixel.label < 0 || pixel.kind != FaceKind::kVague) continue;
      const Eigen::Vector2f& sum = sums[static_cast<size_t>(labels_.Root(pixel.label))];
      if (std::abs(pixel.p_T.z() * sum.y() - sum.x()) < kMaxTopStep * sum.y()) {
        pixel.kind = FaceKind::kTop;
      }
    }
  }

  // True when the first that is seen beside a pixel of a top face is lower: the face ends there.
  bool IsFreeEdge(int u, int v) {
    return IsFree(u, v, 1, 0) || IsFree(u, v, -1, 0) || IsFree(u, v, 0, 1) || IsFree(u, v, 0, -1);
  }

  bool IsFree(int u, int v, int du, int dv) {
    const Pixel& pixel = pixels_[Index(u, v)];
    for (int step = 1; step <= kMaxGap; ++step) {
      const int x = u + step * du, y = v + step * dv;
      if (x < 0 || y < 0 || x >= columns_ || y >= rows_) return false;
      const Pixel& other = pixels_[Index(x, y)];
      if (other.depth <= 0) continue;
      return PointAt(x, y).z() < pixel.p_T.z() - kMaxTopStep;
    }
    return false;
  }

  const PixelWindow window_;
  const Eigen::Isometry3f X_TC_;
  const Observation& observation_;
  const int columns_, rows_;
  std::vector<Pixel> pixels_;
  Labels labels_;
};

}  // namespace

std::vector<SurfacePart> FindParts(const std::vector<uint8_t>& is_marked, const PixelWindow& window,
                                   const Eigen::Isometry3d& X_TC, size_t min_points,
                                   const Observation& observation) {
  std::vector<SurfacePart> parts = PartFinder(window, X_TC, observation).Find(is_marked);
  const auto is_small = [&](const SurfacePart& part) { return part.num_points() < min_points; };
  parts.erase(std::remove_if(parts.begin(), parts.end(), is_small), parts.end());
  return parts;
}

}  // namespace declutter
