#pragma once

#include <cstdint>
#include <vector>

#include "modules/geometry/feature_cloud.h"
#include "modules/hough_segmenter/cell_arrays.h"
#include "modules/hough_segmenter/model_fits.h"

namespace declutter {

// The filters of section 5. Each keeps or clears inliers of a model. An object of this class holds
// nothing but memory that is used again.
class InlierFilters {
 public:
  // Line: inliers form one cluster along the line without a gap over max_gap_m. In paper mode those
  // of several clusters are cleared, else the one with the most points is kept.
  void KeepOneRun(const LineModel& line, float max_gap_m, FeatureMode mode, CellArrays* inliers);

  // Circle: inliers are at the same height; those of another height are dropped.
  void KeepOneHeight(float max_gap_m, CellArrays* inliers);

  // Circle: at most `max_arcs` clusters of inliers, two in the paper; the heaviest stay. Sets the
  // model's arc.
  void KeepArcs(float max_gap_m, size_t max_arcs, CircleModel* circle, CellArrays* inliers);

  // Circle: a cylinder on a wider one has inliers at another distance from the axis above some
  // height. Where the mean distances below and above differ by more than max_step_m, the part with
  // more points stays.
  void KeepOneRadius(const CircleModel& circle, float max_step_m, CellArrays* inliers);

  // Paper mode: keeps inliers whose curvature is that of a flat (line) or round (circle) surface,
  // and for circles those whose minimum radius is within max_radius_difference_m of the circle's.
  void KeepFlat(float max_curvature, CellArrays* inliers);
  void KeepRound(const CircleModel& circle, float max_curvature, float max_radius_difference_m,
                 CellArrays* inliers);

 private:
  // Inliers that follow each other along one coordinate.
  struct Cluster {
    size_t first_bin = 0;
    size_t last_bin = 0;
    float weight = 0;
  };

  // Finds the clusters of the values_ of inliers: where nothing lies for max_gap (to an eighth of
  // it), a new one begins. Keeps the `max_num` heaviest in clusters_; false when there are more.
  bool HasAtMost(size_t max_num, float max_gap, const CellArrays& inliers);
  // Keeps the heaviest of clusters_.
  void KeepHeaviest(size_t max_num, const CellArrays& inliers);
  float SpanOf(const Cluster& cluster) const;
  // Drops the inliers outside clusters_.
  void KeepClusters(CellArrays* inliers);
  template <typename Condition>
  void KeepIf(Condition condition, CellArrays* inliers);

  std::vector<float> values_;  // one for each inlier
  std::vector<float> marks_;
  Range range_;                   // of values_
  std::vector<int32_t> bins_;     // of values_
  std::vector<uint8_t> is_used_;  // of each bin
  std::vector<float> bin_weights_;
  std::vector<Cluster> clusters_;
  std::vector<Eigen::Vector2f> layers_;
};

// True when the weighted median of the horizontal curvature of the inliers is below limit [1/m].
bool IsMedianKappaBelow(float limit, const CellArrays& inliers);

}  // namespace declutter
