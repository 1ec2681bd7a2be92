#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "modules/geometry/feature_cloud.h"
#include "modules/geometry/tabletop.h"

namespace declutter::benchmark {

// A point of a side with its features, in T.
struct SidePoint {
  Eigen::Vector3f p_T;  // [m]
  Eigen::Vector2f n;    // unit horizontal normal
  float curvature = 0;
  float r_min = 0;  // [m]
};

// The side points of each component, the same that hough_segmenter fits to; of each voxel of size
// leaf_m only one, when that is above 0.
std::vector<std::vector<SidePoint>> SidePoints(const Tabletop& tabletop,
                                               const FeatureCloud& paper_features, double leaf_m);

// Section 4 with PCL on one component: num_iterations times line and circle fits by RANSAC with the
// filters of section 5, votes clustered to peaks, inliers recomputed and removed, until nothing is
// found any more. Returns the number of models.
size_t CountVotedModels(const std::vector<SidePoint>& points, int num_iterations);

}  // namespace declutter::benchmark
