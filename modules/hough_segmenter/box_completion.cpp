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

std::vector<Hypothesis> CompleteBoxes(const HoughSegmenterConfig& config,
                                      const Surfaces& surfaces) {
  const auto max_extent = static_cast<float>(config.max_box_extent_m());
  const auto max_joined = static_cast<size_t>(config.max_hypotheses());
  const std::vector<Face> faces = WithJoinedFaces(surfaces.faces, max_extent, max_joined);
  std::vector<Rectangle> rectangles;
  std::vector<char> has_depth(faces.size(), 0);
  for (const TopPatch& patch : WithJoinedPatches(surfaces.tops, max_extent, max_joined)) {
    std::vector<const Face*> attached;
    for (size_t i = 0; i < faces.size(); ++i) {
      if (!IsAttached(faces[i], patch)) continue;
      attached.push_back(&faces[i]);
      if (const auto grown = GrowOver(faces[i], patch, max_extent)) {
        rectangles.push_back(*grown);
        has_depth[i] = 1;
      }
    }
    // Where something in front cuts a face off, the smallest rectangle around the rest lies askew.
    const auto direction = EdgeDirection(patch.free_edge);
    std::vector<Eigen::Vector2f> axes = {direction ? *direction : MinimumAreaAxis(patch)};
    for (const Face* face : attached) axes.push_back(face->model.tangent());
    for (const Eigen::Vector2f& axis : axes) {
      Rectangle r = Around(patch, axis);
      SnapToFaces(attached, &r);
      rectangles.push_back(r);
    }
  }
  for (size_t i = 0; i < faces.size(); ++i) {
    for (size_t j = 0; j < faces.size(); ++j) {
      if (i == j || faces[i].component != faces[j].component) continue;
      if (const auto corner = FromCorner(faces[i], faces[j])) {
        rectangles.push_back(*corner);
        has_depth[i] = has_depth[j] = 1;
      }
    }
  }
  for (size_t i = 0; i < faces.size(); ++i) {
    if (has_depth[i]) continue;
    Rectangle r = FromFace(faces[i]);
    r.b_max = r.b_min + std::clamp(0.5f * faces[i].model.length(), 0.03f, 0.10f);
    r.depth_is_assumed = true;
    rectangles.push_back(r);
  }
  std::vector<Hypothesis> hypotheses;
  for (const Rectangle& r : rectangles) {
    if (IsGraspable(r, max_extent)) hypotheses.push_back(MakeBox(r));
  }
  return hypotheses;
}

}  // namespace declutter
