// What kernels over arrays of cells or points have in common, for each target of Highway.
#if defined(DECLUTTER_CELL_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef DECLUTTER_CELL_LANES_INL_H_
#undef DECLUTTER_CELL_LANES_INL_H_
#else
#define DECLUTTER_CELL_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include "modules/geometry/packing-inl.h"
#include "modules/hough_segmenter/point_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace declutter {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, kCellBlock>;
using Vector = hn::Vec<Floats>;

constexpr float kLeastSquaredDistance = 1e-12f;  // [m^2]

constexpr size_t kLanes = hn::MaxLanes(Floats());
constexpr size_t kVectorsPerBlock = kCellBlock / kLanes;

// The lanes of a vector of elements from i on that are below num.
HWY_INLINE hn::Mask<Floats> LanesBelow(size_t num, size_t i) {
  return hn::FirstN(Floats(), i < num ? HWY_MIN(num - i, kLanes) : 0);
}

// What clears the lanes of a vector beyond the last element.
struct AllLanes {
  HWY_INLINE Vector operator()(const Vector& values) const { return values; }
};
struct SomeLanes {
  HWY_INLINE Vector operator()(const Vector& values) const {
    return hn::IfThenElseZero(is_below, values);
  }
  hn::Mask<Floats> is_below;
};

// Calls add(i, k, keep) for vectors of elements from i on, block by block; keep(values) has 0 for
// the elements from num on, k = 0 .. kVectorsPerBlock - 1 says which partial sums they belong to.
template <typename AddVector>
HWY_INLINE void ForEachVector(size_t num, AddVector add) {
  size_t i = 0;
  for (; i + kCellBlock <= num; i += kCellBlock) {
    for (size_t k = 0; k < kVectorsPerBlock; ++k) add(i + k * kLanes, k, AllLanes());
  }
  if (i == num) return;
  for (size_t k = 0; k < kVectorsPerBlock; ++k) {
    add(i + k * kLanes, k, SomeLanes{LanesBelow(num, i + k * kLanes)});
  }
}

// The sum of 2 * kHalf values, the upper half added to the lower one again and again. The number is
// known to the compiler, which so needs no loop.
template <size_t kHalf>
HWY_INLINE float AddHalves(float* values) {
  for (size_t i = 0; i < kHalf; ++i) values[i] += values[i + kHalf];
  if constexpr (kHalf > 1) return AddHalves<kHalf / 2>(values);
  return values[0];
}

// kNum sums at once, each of kCellBlock partial sums.
template <size_t kNum>
class Sums {
 public:
  HWY_INLINE Sums() {
    for (auto& sum : partials_) {
      for (Vector& partial : sum) partial = hn::Zero(Floats());
    }
  }
  HWY_INLINE void Add(size_t sum, size_t k, const Vector& values) {
    partials_[sum][k] = hn::Add(partials_[sum][k], values);
  }
  HWY_INLINE float operator[](size_t sum) const {
    HWY_ALIGN float values[kCellBlock];
    for (size_t k = 0; k < kVectorsPerBlock; ++k) {
      hn::Store(partials_[sum][k], Floats(), values + k * kLanes);
    }
    return AddHalves<kCellBlock / 2>(values);
  }

 private:
  Vector partials_[kNum][kVectorsPerBlock];
};

}  // namespace HWY_NAMESPACE
}  // namespace declutter
HWY_AFTER_NAMESPACE();

#endif
