#pragma once

#include <vector>

#include "modules/feature_estimator/sphere_window.h"

namespace declutter {

// Unit normals toward the camera, in C, and lambda_0 / (lambda_0 + lambda_1 + lambda_2) of the
// points of a PointImage, element by element. Zero where unknown.
struct NormalImage {
  std::vector<float> x, y, z, curvature;

  bool IsKnown(size_t index) const { return x[index] != 0 || y[index] != 0 || z[index] != 0; }
};

// Principal component analysis of the neighbours of each point (paper, section 3, step iii).
// Unknown where fewer than min_neighbors points are near, the point itself included; a sample
// stands for the points its stride skips.
NormalImage EstimateNormals(const PointImage& points, const Neighborhood& neighborhood,
                            int min_neighbors, NormalImage recycled = {});

}  // namespace declutter
