#pragma once

#include <vector>

#include "modules/hough_segmenter/hough_segmenter.pb.h"
#include "modules/hough_segmenter/model_fits.h"
#include "modules/hough_segmenter/side_cells.h"

namespace declutter {

// What tells inliers among side cells, in arrays of their own, so that it is computed for several
// cells at a time.
class CellArrays {
 public:
  explicit CellArrays(const HoughSegmenterConfig& config);

  void Assign(const std::vector<SideCell>& cells);
  // The cells of another one with these indices.
  void Gather(const CellArrays& from, const std::vector<int>& indices);
  size_t size() const { return px_.size(); }

  // Of the angle between the normals of an inlier and of its model.
  float min_cos() const { return min_cos_; }

  // How well each cell agrees with a model: 0 no inlier, 1 exactly on it with the same normal
  // (equation 1).
  void Agreements(const LineModel& line, std::vector<float>* agreements) const;
  void Agreements(const CircleModel& circle, std::vector<float>* agreements) const;

  // The sum of agreements times weights [px].
  float Support(const std::vector<float>& agreements) const;

 private:
  void Resize(size_t num);
  float Agreement(float squared_distance, float cos_angle, size_t i) const;

  float inlier_distance_m_;
  float min_cos_;
  std::vector<float> px_, py_, nx_, ny_, weight_;
  std::vector<float> inverse_limit_;  // [1/m^2] of the squared distance of an inlier
};

}  // namespace declutter
