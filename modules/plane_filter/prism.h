#pragma once

#include <Eigen/Core>
#include <vector>

#include "modules/geometry/convex_hull.h"
#include "modules/plane_filter/inverse_depth.h"

namespace declutter {

// Convex hull of the marked pixels' places in the plane: x and y of its table frame T [m],
// counter-clockwise seen from the camera.
std::vector<Eigen::Vector2d> HullInPlane(const InverseDepth& image, const InversePlane& plane,
                                         const PixelMask& region);

// The space over and under a convex polygon of a plane (paper, section 3, step i).
class Prism {
 public:
  // hull_T as HullInPlane gives it; margin_m moves its edges outward.
  Prism(const InversePlane& plane, const std::vector<Eigen::Vector2d>& hull_T, double margin_m);

  bool Contains(const Eigen::Vector3d& p_C) const {
    const Eigen::Vector3f p = p_C.cast<float>();
    return base_.Contains(x_axis_.dot(p), y_axis_.dot(p));
  }

  // Per pixel of row v: 1 where it is marked and its point is in the prism.
  void MarkContained(const InverseDepth& image, int v, const uint8_t* marked,
                     uint8_t* contained) const;

 private:
  Eigen::Vector3f x_axis_;  // of T in C; the origin of T is under the camera centre
  Eigen::Vector3f y_axis_;
  ConvexRegion base_;
};

}  // namespace declutter
