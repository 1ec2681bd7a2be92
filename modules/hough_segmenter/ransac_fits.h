#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "modules/geometry/feature_cloud.h"
#include "modules/geometry/random_index.h"
#include "modules/hough_segmenter/cell_arrays.h"
#include "modules/hough_segmenter/hough_segmenter.pb.h"
#include "modules/hough_segmenter/model_fits.h"

namespace declutter {

// RANSAC fits of 2D lines and circles to the side cells of one component (paper, section 4), with
// the inlier filters of section 5.
class SideFitter {
 public:
  // cells must outlive the fitter.
  SideFitter(const HoughSegmenterConfig& config, FeatureMode mode,
             const std::vector<SideCell>& cells, uint64_t seed);

  // The best supported of the random samples among the cells that are set in `is_free`, filtered
  // and refitted; nothing when it keeps fewer than N points.
  std::optional<LineFit> FitLine(const std::vector<char>& is_free);
  std::optional<CircleFit> FitCircle(const std::vector<char>& is_free);

  // Inliers of a known model among the free cells, filtered and refitted by least squares.
  std::optional<LineFit> Refit(const LineModel& model, const std::vector<char>& is_free) const;
  std::optional<CircleFit> Refit(const CircleModel& model, const std::vector<char>& is_free) const;

 private:
  // Indices of two free cells not too far from each other, or nothing.
  std::optional<std::pair<int, int>> SamplePair(const std::vector<char>& is_free);
  void Subsample(const std::vector<char>& is_free);

  // The best supported of num_samples models that sample() proposes, or nothing.
  template <typename Model, typename Sample>
  std::optional<Model> BestSample(Sample sample) const;

  // The filtered free inliers of a model.
  template <typename Model>
  Fit<Model> Inliers(const Model& model, const std::vector<char>& is_free,
                     std::vector<float>* agreements) const;
  void Filter(LineFit* fit) const;
  void Filter(CircleFit* fit) const;

  // Inliers, least squares and inliers again; nothing when fewer than N points are left, or none of
  // a model that cannot be.
  template <typename Model>
  std::optional<Fit<Model>> RefitTo(const Model& model, const std::vector<char>& is_free) const;
  bool IsPossible(const LineFit& fit) const;
  bool IsPossible(const CircleFit& fit) const;

  const HoughSegmenterConfig& config_;
  FeatureMode mode_;
  const std::vector<SideCell>& cells_;
  CellArrays arrays_;
  RandomIndex random_;
  std::vector<int> subsample_;  // cells that samples are scored on
  CellArrays subsample_arrays_;
  std::vector<std::vector<int>> buckets_;  // cells of each square of the table
  std::vector<int> bucket_of_cell_;
  int num_bucket_columns_ = 0;
};

}  // namespace declutter
