#pragma once

#include <vector>

#include "modules/feature_estimator/point_image.h"

namespace declutter {

// Unit normals toward the camera, in C, and lambda_0 / (lambda_0 + lambda_1 + lambda_2) of the
// points of a PointImage, element by element. Zero where unknown.
struct NormalImage {
  std::vector<float> x, y, z, curvature;

  bool IsKnown(size_t index) const { return x[index] != 0 || y[index] != 0 || z[index] != 0; }
};

// Principal component analysis of the points within radius_m of each point (paper, section 3, step
// iii). Unknown with fewer than min_neighbors points, the point itself included.
NormalImage EstimateNormals(const PointImage& points, double radius_m, int min_neighbors);

}  // namespace declutter
