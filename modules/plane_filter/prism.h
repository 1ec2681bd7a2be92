#pragma once

#include <Eigen/Core>
#include <vector>

#include "modules/geometry/convex_hull.h"
#include "modules/plane_filter/inverse_depth.h"

namespace declutter {

// Convex hulls of regions of an image in their planes.
class PlaneHull {
 public:
  // Of the places of the pixels that have this label: x and y of the plane's table frame T [m],
  // counter-clockwise seen from the camera. Valid until the next call.
  const std::vector<Eigen::Vector2d>& Find(const InverseDepth& image, const InversePlane& plane,
                                           const std::vector<uint8_t>& labels, uint8_t label);

 private:
  std::vector<Eigen::Vector2d> points_, hull_;
};

// The space over and under a convex polygon of a plane (paper, section 3, step i).
class Prism {
 public:
  // Nothing is in it.
  Prism() : x_axis_(Eigen::Vector3f::UnitX()), y_axis_(Eigen::Vector3f::UnitY()) {}
  // hull_T as PlaneHull gives it; margin_m moves its edges outward. `recycled` gives its memory.
  Prism(const InversePlane& plane, const std::vector<Eigen::Vector2d>& hull_T, double margin_m,
        Prism recycled = {});

  bool Contains(const Eigen::Vector3d& p_C) const {
    const Eigen::Vector3f p = p_C.cast<float>();
    return base_.Contains(x_axis_.dot(p), y_axis_.dot(p));
  }

  // Per pixel of row v: 1 where it is marked and its point is in the prism.
  void MarkContained(const InverseDepth& image, int v, const uint8_t* marked,
                     uint8_t* contained) const;

 private:
  // Of T in C; the origin of T is under the camera centre.
  Eigen::Vector3f x_axis_;
  Eigen::Vector3f y_axis_;
  ConvexRegion base_;
};

}  // namespace declutter
