#pragma once

#include <Eigen/Core>
#include <vector>

namespace declutter {

// Convex hull of points of a plane, counter-clockwise, without collinear points. Fewer than three
// points that are not collinear give an empty hull.
std::vector<Eigen::Vector2d> ConvexHull(std::vector<Eigen::Vector2d> points);
// The same in given memory; sorts the points.
void ConvexHull(std::vector<Eigen::Vector2d>* points, std::vector<Eigen::Vector2d>* hull);

// The hull without corners that are less than tolerance off the line between their neighbours,
// flattest first. It keeps at least three corners.
std::vector<Eigen::Vector2d> SimplifyHull(std::vector<Eigen::Vector2d> hull, double tolerance);

// The inside of a convex polygon, as one inequality per edge.
class ConvexRegion {
 public:
  ConvexRegion() = default;  // contains nothing
  // hull is counter-clockwise; margin_m > 0 moves every edge outward. `recycled` gives its memory.
  ConvexRegion(const std::vector<Eigen::Vector2d>& hull, double margin_m,
               ConvexRegion recycled = {});

  // False for every point when the hull was empty.
  bool Contains(float x, float y) const {
    for (const Eigen::Vector3f& edge : edges_) {
      if (edge.x() * x + edge.y() * y + edge.z() < 0) return false;
    }
    return !edges_.empty();
  }

  const std::vector<Eigen::Vector3f>& edges() const { return edges_; }

 private:
  std::vector<Eigen::Vector3f> edges_;  // inward unit normal, offset [m]
};

}  // namespace declutter
