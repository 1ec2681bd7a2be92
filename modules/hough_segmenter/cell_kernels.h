#pragma once

#include <cstddef>

#include "modules/hough_segmenter/point_kernels.h"

// Loops over cells by SIMD, dispatched at run time to what the processor has. Results are the same
// bits with every instruction set: nothing is fused, and sums are made of kCellBlock partial sums,
// added in the same order.
namespace declutter {

// What tells whether a cell is an inlier, one array each.
struct CellView {
  const float* x = nullptr;   // [m]
  const float* y = nullptr;   // [m]
  const float* nx = nullptr;  // of the unit normal
  const float* ny = nullptr;
  const float* inverse_limit = nullptr;  // [1/m^2] of the squared distance of an inlier
  const float* weight = nullptr;         // [px] 0 where a cell is not to be looked at
  size_t num = 0;

  CellView Part(size_t begin, size_t num_of_part) const {
    return {x + begin,      y + begin,  nx + begin, ny + begin, inverse_limit + begin,
            weight + begin, num_of_part};
  }
};

// How well each cell agrees with a model: 0 no inlier or of no weight, 1 exactly on it with the
// same normal (equation 1). min_cos: of the angle between the normals of an inlier and of its
// model.
void Agreements(const CellView& cells, const LineShape& line, float min_cos, float* agreements);
void Agreements(const CellView& cells, const CircleShape& circle, float min_cos, float* agreements);

// Of num models each the sum of agreements times weights [px], for circles with the distance to
// first order, (d^2 - r^2) / 2r.
void Supports(const CellView& cells, const LineShape* lines, size_t num, float min_cos,
              float* supports);
void Supports(const CellView& cells, const CircleShape* circles, size_t num, float min_cos,
              float* supports);

// Copies the elements of num_fields arrays for which marks are positive. Arrays of `from` are
// from_stride elements apart, those of `to` to_stride; both may be the same memory. Returns how
// many elements of each array were kept.
size_t CopyMarked(const float* marks, size_t num, size_t num_fields, const float* from,
                  size_t from_stride, float* to, size_t to_stride);

// Of num > 0 values, and reads no others.
Range RangeOf(const float* values, size_t num);

float SumOf(const float* values, size_t num);
float SumOfProducts(const float* a, const float* b, size_t num);

// The sum of the weights of the values below limit.
float WeightBelow(const float* values, const float* weights, size_t num, float limit);

}  // namespace declutter
