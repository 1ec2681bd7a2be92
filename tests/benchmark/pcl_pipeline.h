#pragma once

#include <cstddef>
#include <memory>

#include "modules/geometry/depth_image.h"
#include "modules/geometry/feature_cloud.h"
#include "modules/geometry/tabletop.h"

// The paper's pipeline as one writes it with PCL, stage by stage, each on the points that our own
// stage gets.
namespace declutter::benchmark {

// Point cloud data, ready made: converting is not part of the competitor's time.
class PclFrame {
 public:
  // leaf_m > 0: clouds are thinned to a voxel grid of that size, which is part of a stage's time.
  PclFrame(const DepthFrame& frame, const Tabletop& tabletop, const FeatureCloud& paper_features,
           double leaf_m);
  ~PclFrame();
  PclFrame(PclFrame&&) noexcept;

  // Support plane by RANSAC, points over its hull, statistical outlier removal with k = 50
  // (section 3, steps i and ii). Returns the number of points kept.
  size_t FilterPlane() const;

  // Normals, radius-based surface descriptor and Euclidean clusters (steps iii to v).
  size_t EstimateFeatures(int num_threads) const;

  // I iterations of line and circle fits by RANSAC on each cluster, the filters of section 5, votes
  // and peaks (section 4). Returns the number of models.
  size_t Segment(int num_iterations) const;

  size_t num_object_points() const;

 private:
  struct Clouds;
  std::unique_ptr<Clouds> clouds_;
};

}  // namespace declutter::benchmark
