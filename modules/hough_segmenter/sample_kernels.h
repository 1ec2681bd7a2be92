#pragma once

#include <cstddef>
#include <vector>

#include "modules/hough_segmenter/cell_kernels.h"

// The models through many samples at a time, by SIMD as in cell_kernels.h.
namespace declutter {

// What a model is laid through of a cell.
struct SampleCell {
  float x = 0, y = 0;    // [m]
  float nx = 0, ny = 0;  // unit normal
  float limit = 0;       // [m] from its model at which it is an inlier
};

// Samples of two cells a and b each, every property in an array of its own. Memory is used again.
class SamplePairs {
 public:
  enum Field { kAx, kAy, kAnx, kAny, kALimit, kBx, kBy, kBnx, kBny, kBLimit, kNumFields };

  void Clear() { num_ = 0; }
  void Add(const SampleCell& a, const SampleCell& b);
  size_t size() const { return num_; }
  bool empty() const { return num_ == 0; }
  const float* field(Field field) const { return values_.data() + field * stride_; }

 private:
  void Grow();

  size_t num_ = 0;
  size_t stride_ = 0;
  std::vector<float> values_;
};

// Sets lines to those through both cells of a pair, outward on the side of their normals, where
// both normals are within the angle of min_cos of the line's.
void LinesThrough(const SamplePairs& pairs, float min_cos, std::vector<LineShape>* lines);

// Sets circles to those around where the normals of two cells meet, going inward, whose radius is
// within radii and from which both cells are within their limits. None where the normals are almost
// parallel or meet outside.
void CirclesThrough(const SamplePairs& pairs, const Range& radii,
                    std::vector<CircleShape>* circles);

}  // namespace declutter
