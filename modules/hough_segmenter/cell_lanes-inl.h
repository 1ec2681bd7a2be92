// What kernels over arrays of cells or points have in common, for each target of Highway.
#if defined(DECLUTTER_CELL_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef DECLUTTER_CELL_LANES_INL_H_
#undef DECLUTTER_CELL_LANES_INL_H_
#else
#define DECLUTTER_CELL_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include "modules/hough_segmenter/point_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace declutter {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, kCellBlock>;
using Vector = hn::Vec<Floats>;

constexpr float kLeastSquaredDistance = 1e-12f;  // [m^2]

// The lanes of a vector of elements from i on that are below num > i.
HWY_INLINE hn::Mask<Floats> LanesBelow(size_t num, size_t i) {
  return hn::FirstN(Floats(), HWY_MIN(num - i, hn::Lanes(Floats())));
}

// Calls add(i, mask, k) for vectors of elements from i on, of which those in the mask are below
// num; k = 0 .. kCellBlock / lanes - 1 says which partial sums they belong to.
template <typename AddVector>
HWY_INLINE void ForEachVector(size_t num, AddVector add) {
  const Floats f;
  const size_t lanes = hn::Lanes(f);
  size_t i = 0;
  for (; i + kCellBlock <= num; i += kCellBlock) {
    for (size_t k = 0; k < kCellBlock / lanes; ++k) {
      add(i + k * lanes, LanesBelow(num, i + k * lanes), k);
    }
  }
  for (size_t k = 0; i < num; ++k, i += lanes) add(i, LanesBelow(num, i), k);
}

// kNum sums at once, each of kCellBlock partial sums.
template <size_t kNum>
class Sums {
 public:
  HWY_INLINE Sums() {
    for (float& partial : partials_) partial = 0;
  }
  HWY_INLINE void Add(size_t sum, size_t k, const Vector& values) {
    const Floats f;
    float* partial = partials_ + sum * kCellBlock + k * hn::Lanes(f);
    hn::Store(hn::Add(hn::Load(f, partial), values), f, partial);
  }
  HWY_INLINE float operator[](size_t sum) const {
    float halves[kCellBlock];
    for (size_t i = 0; i < kCellBlock; ++i) halves[i] = partials_[sum * kCellBlock + i];
    for (size_t width = kCellBlock / 2; width > 0; width /= 2) {
      for (size_t i = 0; i < width; ++i) halves[i] += halves[i + width];
    }
    return halves[0];
  }

 private:
  HWY_ALIGN float partials_[kNum * kCellBlock];
};

}  // namespace HWY_NAMESPACE
}  // namespace declutter
HWY_AFTER_NAMESPACE();

#endif
