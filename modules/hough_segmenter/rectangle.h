#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "modules/geometry/solid.h"
#include "modules/hough_segmenter/side_voting.h"
#include "modules/hough_segmenter/top_patches.h"

namespace declutter {

// A box seen from above: p = a * axis + b * perpendicular, in T.
struct Rectangle {
  Eigen::Vector2f axis = Eigen::Vector2f::UnitX();
  float a_min = 0, a_max = 0, b_min = 0, b_max = 0;  // [m]
  float z_min = 0, z_max = 0;                        // [m]
  bool depth_is_assumed = false;                     // extent along b
  int component = 0;
  int num_votes = 0;
  int num_points = 0;
  float score = 0;

  Eigen::Vector2f perpendicular() const { return {-axis.y(), axis.x()}; }
};

// The standing box over a rectangle, in T. A box whose lower end is near the support stands on it.
Hypothesis MakeBox(const Rectangle& r);

// Rectangle without depth on a face, its body behind it.
Rectangle FromFace(const Face& face);

// True when the face reaches up to the patch and the patch begins at the face.
bool IsAttached(const Face& face, const TopPatch& patch);

// Moves the edges of a rectangle onto the faces that lie along them, and its bottom down to theirs.
void SnapToFaces(const std::vector<const Face*>& faces, Rectangle* r);

// The box of two perpendicular faces that meet at a vertical edge.
std::optional<Rectangle> FromCorner(const Face& front, const Face& side);

// Finds rectangles among the points of top patches, with memory that is used again.
class RectangleFinder {
 public:
  // Rectangle around a top patch with sides along axis.
  Rectangle Around(const TopPatch& patch, const Eigen::Vector2f& axis);

  // Grows the face backwards over the part of the top face within its width; stops where less than
  // a third of the width is covered. Nothing when the top does not begin at the face.
  std::optional<Rectangle> GrowOver(const Face& face, const TopPatch& patch, float max_extent);

 private:
  // Sets a_ and b_ to the positions of the points of a patch along and across an axis.
  void FindPositions(const PlanarPoints& points, const Eigen::Vector2f& axis);

  std::vector<float> a_, b_;  // [m]
  std::vector<int> profile_;
};

}  // namespace declutter
