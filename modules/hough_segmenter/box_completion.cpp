#include <algorithm>

#include "modules/geometry/edge_direction.h"
#include "modules/hough_segmenter/joining.h"
#include "modules/hough_segmenter/rectangle.h"
#include "modules/hough_segmenter/solid_completion.h"

namespace declutter {
namespace {

constexpr float kMinExtent = 0.015f;  // [m] of a box

bool IsGraspable(const Rectangle& r, float max_extent) {
  const float a = r.a_max - r.a_min;
  const float b = r.b_max - r.b_min;
  return a > kMinExtent && b > kMinExtent && a < max_extent && b < max_extent;
}

}  // namespace

void SolidCompletion::AddRectangles(const TopPatch& patch) {
  const auto max_extent = static_cast<float>(config_.max_box_extent_m());
  attached_.clear();
  for (size_t i = 0; i < faces_.size(); ++i) {
    if (!IsAttached(faces_[i], patch)) continue;
    attached_.push_back(&faces_[i]);
    if (const auto grown = rectangle_finder_.GrowOver(faces_[i], patch, max_extent)) {
      rectangles_.push_back(*grown);
      has_depth_[i] = 1;
    }
  }
  const auto add_around = [&](const Eigen::Vector2f& axis) {
    rectangles_.push_back(rectangle_finder_.Around(patch, axis));
    SnapToFaces(attached_, &rectangles_.back());
  };
  // Where something in front cuts a face off, the smallest rectangle around the rest lies askew.
  const auto direction = EdgeDirection(patch.free_edge);
  add_around(direction ? *direction : MinimumAreaAxis(patch));
  for (const Face* face : attached_) add_around(face->model.tangent());
}

void SolidCompletion::CompleteBoxes(const std::vector<Face>& faces, const TopPatches& tops,
                                    std::vector<Hypothesis>* hypotheses) {
  const auto max_extent = static_cast<float>(config_.max_box_extent_m());
  const auto max_joined = static_cast<size_t>(config_.max_hypotheses());
  faces_ = faces;
  AppendJoinedFaces(max_extent, max_joined, &faces_);
  JoinPatches(tops, max_extent, max_joined, &joined_tops_);
  has_depth_.assign(faces_.size(), 0);
  rectangles_.clear();
  for (const TopPatch& patch : tops) AddRectangles(patch);
  for (const TopPatch& patch : joined_tops_) AddRectangles(patch);
  for (size_t i = 0; i < faces_.size(); ++i) {
    for (size_t j = 0; j < faces_.size(); ++j) {
      if (i == j || faces_[i].component != faces_[j].component) continue;
      if (const auto corner = FromCorner(faces_[i], faces_[j])) {
        rectangles_.push_back(*corner);
        has_depth_[i] = has_depth_[j] = 1;
      }
    }
  }
  for (size_t i = 0; i < faces_.size(); ++i) {
    if (has_depth_[i]) continue;
    Rectangle r = FromFace(faces_[i]);
    r.b_max = r.b_min + std::clamp(0.5f * faces_[i].model.length(), 0.03f, 0.10f);
    r.depth_is_assumed = true;
    rectangles_.push_back(r);
  }
  for (const Rectangle& r : rectangles_) {
    if (IsGraspable(r, max_extent)) hypotheses->push_back(MakeBox(r));
  }
}

}  // namespace declutter
