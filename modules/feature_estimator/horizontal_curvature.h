#pragma once

#include <Eigen/Core>
#include <vector>

#include "modules/feature_estimator/normals.h"
#include "modules/feature_estimator/sphere_window.h"

namespace declutter {

struct CurvatureWindow {
  Neighborhood neighborhood;
  double max_tilt_rad = 0;  // largest angle between the normal of a side point and the horizontal
  double max_residual = 0;  // rms of n . t about its line over which a window straddles an edge
};

// What EstimateHorizontalCurvature gives, and what it needs meanwhile.
struct CurvatureImage {
  std::vector<float> kappa;                            // [1/m] element by element
  std::vector<float> side_x;                           // x of points on sides, kFar elsewhere
  std::vector<float> tangent_x, tangent_y, tangent_z;  // horizontal tangents of points on sides
};

// Signed curvature of side faces in the horizontal plane, convex > 0, element by element of
// the PointImage; 1 / radius on an upright cylinder, 0 on planes and on points not on a side. up_C
// is the unit normal of the support.
//
// Over the side points q within the window of p, n . t, the component of q's normal along the
// horizontal tangent t at p, grows with the offset of q along t; kappa is the slope. Where that is
// not a line, p is beside a vertical edge and the half window on p's own side of it is used.
CurvatureImage EstimateHorizontalCurvature(const PointImage& points, const NormalImage& normals,
                                           const Eigen::Vector3d& up_C,
                                           const CurvatureWindow& window,
                                           CurvatureImage recycled = {});

}  // namespace declutter
