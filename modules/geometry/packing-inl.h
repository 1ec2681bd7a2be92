// Moves marked lanes to the front of vectors, for each target of Highway.
#if defined(DECLUTTER_PACKING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef DECLUTTER_PACKING_INL_H_
#undef DECLUTTER_PACKING_INL_H_
#else
#define DECLUTTER_PACKING_INL_H_
#endif

#include <hwy/highway.h>

#include "modules/geometry/packing_table.h"

HWY_BEFORE_NAMESPACE();
namespace declutter {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// The marked lanes of any number of vectors of floats, or of 32-bit integers, one behind the other;
// behind the last of them is anything. hn::Compress of Highway 1.0 copies a table of 1 KB to the
// stack, each time, where the processor has no instruction for it; hn::CompressStore is slow on
// some that have one.
template <class D>
class Packing {
 public:
  using Vector = hn::Vec<D>;
  using Ints = hn::RebindToSigned<D>;
  using IntVector = hn::Vec<Ints>;

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_SSSE3
  HWY_INLINE Packing(D d, const hn::Mask<D>& is_marked)
      : lanes_(hn::IndicesFromVec(d, LanesOf(d, is_marked))) {}

  HWY_INLINE Vector operator()(const Vector& values) const {
    return hn::TableLookupLanes(values, lanes_);
  }

 private:
  static HWY_INLINE IntVector LanesOf(D d, const hn::Mask<D>& is_marked) {
    const hn::Rebind<uint8_t, D> bytes;
    uint8_t set[8];
    hn::StoreMaskBits(d, is_marked, set);
    return hn::PromoteTo(Ints(), hn::LoadU(bytes, kPackedLanes[set[0]].data()));
  }

  decltype(hn::IndicesFromVec(D(), IntVector())) lanes_;
#else
  HWY_INLINE Packing(D, const hn::Mask<D>& is_marked) : is_marked_(is_marked) {}

  HWY_INLINE Vector operator()(const Vector& values) const {
    return hn::Compress(values, is_marked_);
  }

 private:
  hn::Mask<D> is_marked_;
#endif

 public:
  HWY_INLINE IntVector operator()(const IntVector& values) const {
    return hn::BitCast(Ints(), (*this)(hn::BitCast(D(), values)));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace declutter
HWY_AFTER_NAMESPACE();

#endif
