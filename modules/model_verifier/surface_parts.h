#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <vector>

#include "modules/geometry/disjoint_sets.h"
#include "modules/geometry/reused_list.h"
#include "modules/model_verifier/observation.h"
#include "modules/model_verifier/projection.h"

namespace declutter {

// Points that seem to be of one solid, in the table frame T of the support plane: a top face of one
// height with what is seen below its front edge, or a side without a top.
struct SurfacePart {
  std::vector<Eigen::Vector3f> tops;     // [m]
  std::vector<Eigen::Vector3f> sides;    // [m] all others
  std::vector<Eigen::Vector2f> outline;  // [m] of it seen from above: the sides, and the edge of
                                         // the top where nothing in front cuts it off
  size_t num_points() const { return tops.size() + sides.size(); }
};

using SurfaceParts = ReusedList<SurfacePart>;

// What a normal at a point tells of the face it is on, or the most telling one of a part. Around
// edges it is blurred, or there is none.
enum class FaceKind : int8_t { kVague, kSide, kTop };

// Parts of which some turn out to be the same.
class PartLabels {
 public:
  void Clear() {
    sets_.Reset(0);
    kind_.clear();
  }
  int32_t New(FaceKind kind) {
    kind_.push_back(kind);
    return static_cast<int32_t>(sets_.Add());
  }
  size_t Root(int32_t label) { return sets_.Root(static_cast<size_t>(label)); }
  FaceKind KindOf(int32_t label) { return kind_[Root(label)]; }
  void Raise(int32_t label, FaceKind kind) {
    FaceKind& known = kind_[Root(label)];
    known = std::max(known, kind);
  }
  void Join(int32_t a, int32_t b) {
    const FaceKind kind = std::max(KindOf(a), KindOf(b));
    sets_.Join(static_cast<size_t>(a), static_cast<size_t>(b));
    Raise(a, kind);
  }
  size_t size() const { return sets_.size(); }

 private:
  DisjointSets sets_;
  std::vector<FaceKind> kind_;
};

// Finds parts again and again, with memory that is used again.
class PartFinder {
 public:
  // Parts of at least min_points points among the marked pixels of a window of the grid, in
  // row-major order of their first pixels. is_marked has one element per pixel of the grid. The
  // result is valid until the next call.
  const SurfaceParts& Find(const std::vector<uint8_t>& is_marked, const PixelWindow& window,
                           const Eigen::Isometry3d& X_TC, size_t min_points,
                           const Observation& observation);

 private:
  struct Pixel {
    Eigen::Vector3f p_T = Eigen::Vector3f::Zero();
    float depth = 0;  // [m], 0: not measured
    FaceKind kind = FaceKind::kVague;
    int32_t label = -1;  // -1: not marked

    bool is_top() const { return kind == FaceKind::kTop; }
  };
  // What one search works on.
  struct Input {
    const std::vector<uint8_t>& is_marked;
    const Observation& observation;
    PixelWindow window;
    Eigen::Isometry3f X_TC;
  };

  size_t Index(int u, int v) const { return static_cast<size_t>(v * columns_ + u); }
  Eigen::Vector3f PointAt(int u, int v, const Input& input) const;
  void Measure(int u, int v, const Input& input);
  void Join(int u, int v);
  int32_t LabelIfJoined(const Pixel& pixel, const Pixel& other, bool is_above);
  bool AreOnePart(const Pixel& pixel, int32_t a, int32_t b);
  void GrowTopsOverRims();
  bool IsFreeEdge(int u, int v, const Input& input) const;
  bool IsFree(int u, int v, int du, int dv, const Input& input) const;
  void GatherParts(const Input& input);
  void DropSmall(size_t min_points);

  int columns_ = 0, rows_ = 0;  // of the window
  std::vector<Pixel> pixels_;
  PartLabels labels_;
  std::vector<Eigen::Vector2f> sums_;  // of heights and of 1, per label
  SurfaceParts parts_;
};

}  // namespace declutter
