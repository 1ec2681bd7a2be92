#include "modules/hough_segmenter/quantile.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "modules/hough_segmenter/quantile.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once for each target
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "modules/hough_segmenter/cell_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace declutter {
namespace HWY_NAMESPACE {

constexpr size_t kNumBins = 256;

// Value x is in bin (x - low) * bins_per_unit, rounded down. Neighbours are counted apart, for many
// may be in one bin, and a count waits for the last one.
void CountInBins(const float* values, size_t num, float low, float bins_per_unit,
                 uint32_t* num_in_bin) {
  constexpr size_t kNumParts = 4;
  const Floats f;
  const hn::RebindToSigned<Floats> i32;
  HWY_ALIGN int32_t bins[kLanes];
  uint32_t parts[kNumParts][kNumBins] = {};
  for (size_t i = 0; i < num; i += kLanes) {
    const auto steps =
        hn::Mul(hn::Sub(hn::LoadU(f, values + i), hn::Set(f, low)), hn::Set(f, bins_per_unit));
    hn::Store(hn::ConvertTo(i32, steps), i32, bins);
    for (size_t k = 0; k < HWY_MIN(kLanes, num - i); ++k) ++parts[k % kNumParts][bins[k]];
  }
  for (size_t bin = 0; bin < kNumBins; ++bin) {
    num_in_bin[bin] = parts[0][bin] + parts[1][bin] + parts[2][bin] + parts[3][bin];
  }
}

// Copies the values in a bin; returns their number.
size_t CopyBin(const float* values, size_t num, float low, float bins_per_unit, size_t bin,
               float* values_in_bin) {
  const Floats f;
  const auto begin = hn::Set(f, static_cast<float>(bin));
  const auto end = hn::Set(f, static_cast<float>(bin + 1));
  size_t num_copied = 0;
  for (size_t i = 0; i < num; i += kLanes) {
    const auto value = hn::LoadU(f, values + i);
    const auto steps = hn::Mul(hn::Sub(value, hn::Set(f, low)), hn::Set(f, bins_per_unit));
    const auto is_in_bin =
        hn::And(LanesBelow(num, i), hn::And(hn::Ge(steps, begin), hn::Lt(steps, end)));
    const size_t num_here = hn::CountTrue(f, is_in_bin);
    if (num_here == 0) continue;
    hn::StoreU(Packing<Floats>(f, is_in_bin)(value), f, values_in_bin + num_copied);
    num_copied += num_here;
  }
  return num_copied;
}

}  // namespace HWY_NAMESPACE
}  // namespace declutter
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace declutter {
namespace {

HWY_EXPORT(CountInBins);
HWY_EXPORT(CopyBin);

}  // namespace

// A histogram tells which few values come into question, so that hardly a branch depends on data.
Range Quantiles(std::vector<float>* values, double low_fraction, double high_fraction) {
  constexpr size_t kNumBins = HWY_NAMESPACE::kNumBins;
  const size_t num = values->size();
  const Range range = RangeOf(values->data(), num);
  if (!(range.high > range.low)) return range;
  const float bins_per_unit = (static_cast<float>(kNumBins) - 0.5f) / (range.high - range.low);
  // Room for the last block of values, and for that of those in one bin.
  values->resize(2 * num + 2 * kCellBlock);
  float* in_bin = values->data() + num + kCellBlock;
  std::array<uint32_t, kNumBins> num_in_bin{};
  HWY_DYNAMIC_DISPATCH(CountInBins)
  (values->data(), num, range.low, bins_per_unit, num_in_bin.data());
  const auto value_at = [&](double fraction) {
    auto rank = static_cast<size_t>(fraction * static_cast<double>(num - 1));
    size_t bin = 0;
    while (rank >= num_in_bin[bin]) rank -= num_in_bin[bin++];
    const size_t num_copied =
        HWY_DYNAMIC_DISPATCH(CopyBin)(values->data(), num, range.low, bins_per_unit, bin, in_bin);
    std::nth_element(in_bin, in_bin + rank, in_bin + num_copied);
    return in_bin[rank];
  };
  const float low = value_at(low_fraction);
  const float high = high_fraction == low_fraction ? low : value_at(high_fraction);
  values->resize(num);
  return {low, high};
}

}  // namespace declutter
#endif
