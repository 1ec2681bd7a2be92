#include "modules/hough_segmenter/cell_arrays.h"

#include <algorithm>

namespace declutter {

float InlierLimit(const SideCell& cell, float inlier_distance_m) {
  return std::max(inlier_distance_m, 2.5f * cell.sigma);
}

void CellArrays::Resize(size_t num) {
  num_ = num;
  num_fields_ = kNumFields;
  // Kernels read and write whole blocks, from any element on.
  stride_ = (num / kCellBlock + 2) * kCellBlock;
  if (values_.size() < kNumFields * stride_) values_.resize(kNumFields * stride_);
}

void CellArrays::Set(size_t i, const SideCell& cell, size_t index, float inlier_distance_m) {
  const float limit = InlierLimit(cell, inlier_distance_m);
  field(kX)[i] = cell.p.x();
  field(kY)[i] = cell.p.y();
  field(kNormalX)[i] = cell.n.x();
  field(kNormalY)[i] = cell.n.y();
  field(kInverseLimit)[i] = 1 / (limit * limit);
  field(kWeight)[i] = cell.weight;
  field(kZ)[i] = cell.z;
  field(kFitWeight)[i] = cell.weight / (cell.sigma * cell.sigma);
  field(kKappa)[i] = cell.kappa;
  field(kCurvature)[i] = cell.curvature;
  field(kMinRadius)[i] = cell.r_min;
  field(kIndex)[i] = static_cast<float>(index);
}

void CellArrays::CopyMarked(const CellArrays& from, const float* marks, size_t num_fields) {
  const size_t num = from.num_;
  if (this != &from) Resize(num);
  num_fields_ = num_fields;
  num_ = declutter::CopyMarked(marks, num, num_fields, from.values_.data(), from.stride_,
                               values_.data(), stride_);
}

CellView CellArrays::view() const {
  return {field(kX),      field(kY), field(kNormalX), field(kNormalY), field(kInverseLimit),
          field(kWeight), num_};
}

}  // namespace declutter
