#pragma once

#include <cstddef>
#include <vector>

#include "modules/hough_segmenter/cell_kernels.h"
#include "modules/hough_segmenter/side_cells.h"

namespace declutter {

// Side cells, each property in an array of its own, so that it is read for many cells at a time.
// Memory once taken is used again.
class CellArrays {
 public:
  enum Field {
    kX,          // [m] mean position in the xy plane of T
    kY,          // [m]
    kWeight,     // number of points
    kZ,          // [m] mean height
    kFitWeight,  // [1/m^2] in least squares: points over variance
    kKappa,      // [1/m] mean
    kIndex,      // of the cell in its component; exact below 2^24
    kAgreement,  // with the model that was last looked at
    kNumFieldsOfInlier,
    kCurvature = kNumFieldsOfInlier,  // [1] mean (paper mode)
    kMinRadius,                       // [m] mean (paper mode)
    kNumPaperFieldsOfInlier,
    kNormalX = kNumPaperFieldsOfInlier,  // unit mean horizontal normal
    kNormalY,                            //
    kInverseLimit,  // [1/m^2] of the squared distance of an inlier from its model
    kNumFields
  };

  // Makes room for num cells without keeping what is there.
  void Resize(size_t num);
  // inlier_distance_m: smallest distance at which a cell is an inlier (HoughSegmenterConfig).
  void Set(size_t i, const SideCell& cell, size_t index, float inlier_distance_m);

  // The cells of another one for which marks are positive, in the same order. marks is as long as
  // from, and kCellBlock elements more. Only the first num_fields are copied.
  void CopyMarked(const CellArrays& from, const float* marks, size_t num_fields);
  // Drops the cells for which marks are not positive.
  void KeepMarked(const std::vector<float>& marks) { CopyMarked(*this, marks.data(), num_fields_); }

  size_t size() const { return num_; }
  bool empty() const { return num_ == 0; }
  float* field(Field f) { return values_.data() + f * stride_; }
  const float* field(Field f) const { return values_.data() + f * stride_; }
  size_t IndexOf(size_t i) const { return static_cast<size_t>(field(kIndex)[i]); }
  CellView view() const;

  // [px] in all cells.
  float NumPoints() const { return SumOf(field(kWeight), num_); }

 private:
  size_t num_ = 0;
  size_t num_fields_ = kNumFields;  // that hold something
  size_t stride_ = 0;               // from one array to the next, whole blocks
  std::vector<float> values_;
};

// [m] from its model at which a cell is still an inlier.
float InlierLimit(const SideCell& cell, float inlier_distance_m);

}  // namespace declutter
