#pragma once

#include <Eigen/Core>
#include <optional>
#include <random>
#include <vector>

#include "modules/geometry/feature_cloud.h"
#include "modules/hough_segmenter/hough_segmenter.pb.h"
#include "modules/hough_segmenter/side_cells.h"

namespace declutter {

// A vertical face seen from above: the part [s_min, s_max] of the line n . p = rho, at heights
// [z_min, z_max]. All in T.
struct LineModel {
  Eigen::Vector2f n = Eigen::Vector2f::UnitX();  // unit, outward
  float rho = 0;                                 // [m]
  float s_min = 0;                               // [m] along tangent()
  float s_max = 0;                               // [m]
  float z_min = 0;                               // [m]
  float z_max = 0;                               // [m]

  Eigen::Vector2f tangent() const { return {-n.y(), n.x()}; }
  Eigen::Vector2f PointAt(float s) const { return rho * n + s * tangent(); }
  float length() const { return s_max - s_min; }
};

// A vertical cylinder seen from above, at heights [z_min, z_max]. All in T.
struct CircleModel {
  Eigen::Vector2f c = Eigen::Vector2f::Zero();  // [m]
  float r = 0;                                  // [m]
  float z_min = 0;                              // [m]
  float z_max = 0;                              // [m]
  float arc = 0;                                // [rad] part of the circle that was seen
};

// A model with the cells that support it.
template <typename Model>
struct Fit {
  Model model;
  float support = 0;         // [px] weighted by how well each inlier fits
  float num_points = 0;      // [px] in all inliers
  std::vector<int> inliers;  // indices of cells, ascending
};
using LineFit = Fit<LineModel>;
using CircleFit = Fit<CircleModel>;

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

  LineFit Inliers(const LineModel& model, const std::vector<char>& is_free) const;
  CircleFit Inliers(const CircleModel& model, const std::vector<char>& is_free) const;

  // How well a cell agrees with a model: 0 no inlier, 1 exactly on it with the same normal.
  float Agreement(const SideCell& cell, const LineModel& model) const;
  float Agreement(const SideCell& cell, const CircleModel& model) const;
  float Agreement(float distance_m, float cos_angle, float sigma) const;

  const HoughSegmenterConfig& config_;
  FeatureMode mode_;
  const std::vector<SideCell>& cells_;
  float min_cos_;
  std::mt19937_64 random_;
  std::vector<int> subsample_;             // cells that samples are scored on
  std::vector<std::vector<int>> buckets_;  // cells of each square of the table
  std::vector<int> bucket_of_cell_;
  int num_bucket_columns_ = 0;
};

}  // namespace declutter
