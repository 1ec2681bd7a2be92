#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "modules/geometry/feature_cloud.h"
#include "modules/hough_segmenter/cell_buckets.h"
#include "modules/hough_segmenter/hough_segmenter.pb.h"
#include "modules/hough_segmenter/inlier_filters.h"
#include "modules/hough_segmenter/model_fits.h"
#include "modules/hough_segmenter/sample_kernels.h"

namespace declutter {

// RANSAC fits of 2D lines and circles to the side cells of one component (paper, section 4), with
// the inlier filters of section 5. Components come one after the other and use the same memory.
//
// Cells are open until a detection explains them. An iteration of section 4 begins with all open
// cells and takes the inliers of its fits out, for itself alone.
class SideFitter {
 public:
  explicit SideFitter(const HoughSegmenterConfig& config);

  // Begins a component, of which all cells are open. cells must outlive its fits. When max_tests
  // tests of a cell against a line or circle are spent, FitLine and FitCircle find nothing more.
  void Assign(FeatureMode mode, const std::vector<SideCell>& cells, uint64_t seed,
              int64_t max_tests = std::numeric_limits<int64_t>::max());

  // Begins an iteration.
  void Restart();

  // The best supported of the random samples among the cells left in this iteration, filtered and
  // refitted; false when it keeps fewer than N points.
  bool FitLine(LineFit* fit);
  bool FitCircle(CircleFit* fit);

  // Takes inliers of a fit, all of which are left, out of the iteration.
  void Take(const CellSet& inliers);

  // Inliers of a known model among the open cells, filtered and refitted by least squares; false
  // when it keeps fewer than N points.
  bool Refit(const LineModel& model, LineFit* fit);
  bool Refit(const CircleModel& model, CircleFit* fit);

  // Closes open cells. Restart() must follow before more is fitted.
  void Explain(const CellSet& cells);

  const std::vector<SideCell>& cells() const { return *cells_; }
  bool is_spent() const { return num_tests_ >= max_tests_; }
  int64_t num_tests() const { return num_tests_; }  // since Assign()

 private:
  // Draws num_samples pairs of cells that are left, near each other, for both shapes.
  void DrawPairs();
  // The models through pairs whose cells agree with them.
  void FindCandidates(std::vector<LineShape>* lines) const;
  void FindCandidates(std::vector<CircleShape>* circles) const;

  // The best supported of num_samples samples, refitted.
  template <typename Shape, typename Model>
  bool FitBest(std::vector<Shape>* candidates, Fit<Model>* fit);
  // Sets scores_ and ranking_ such that the first of the best supported candidates is
  // candidates[ranking_[0]]; false when none has support.
  template <typename Shape>
  bool Rank(const std::vector<Shape>& candidates);

  // Fills inliers_ with the filtered inliers of a model among the open cells with a weight; false
  // when they have fewer than N points.
  template <typename Model>
  bool FindInliers(const float* weights, Model* model);
  void Filter(LineModel* line);
  void Filter(CircleModel* circle);
  // Whether curvature and radius allow that inliers_ are those of the model, or of one whose
  // quantities differ by the factor `slack`.
  bool IsPossible(const LineModel& line, float slack) const;
  bool IsPossible(const CircleModel& circle, float slack) const;

  // Inliers, least squares and inliers again; false when fewer than N points are left, or those of
  // a model that cannot be.
  template <typename Model>
  bool RefitTo(Model model, const float* weights, Fit<Model>* fit);

  // The open cells with other weights.
  CellView OpenCells(const float* weights) const;

  HoughSegmenterConfig config_;
  float min_cos_;  // of the angle between the normals of an inlier and of its model
  Range radii_;    // [m]
  InlierFilters filters_;
  FeatureMode mode_ = FeatureMode::kDefault;
  const std::vector<SideCell>* cells_ = nullptr;
  RandomIndex random_{0};
  int64_t max_tests_ = 0;
  int64_t num_tests_ = 0;
  CellArrays open_;                  // in random order: each part of it is a random sample
  std::vector<size_t> place_;        // in open_ of each open cell
  std::vector<float> left_weights_;  // of the open cells, 0 when taken in this iteration
  size_t num_left_ = 0;              // cells
  float num_points_left_ = 0;        // [px]
  CellArrays inliers_;
  CellBuckets buckets_;  // of the cells that are left
  std::vector<float> marks_;
  std::vector<size_t> order_;
  std::vector<SampleCell> sample_cells_;  // all cells
  SamplePairs pairs_;                     // empty until they are drawn
  std::vector<LineShape> lines_;
  std::vector<CircleShape> circles_;
  std::vector<float> scores_;    // [px] support of candidates
  std::vector<size_t> ranking_;  // of candidates
};

}  // namespace declutter
