#include "modules/plane_filter/pixel_kernels.h"

#include <algorithm>
#include <array>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "modules/plane_filter/pixel_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once for each target
#include <hwy/highway.h>

#include "modules/geometry/packing-inl.h"

HWY_BEFORE_NAMESPACE();
namespace declutter {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, kKernelPadding>;
using Ints = hn::RebindToSigned<Floats>;
using Bytes = hn::Rebind<uint8_t, Floats>;
using Vector = hn::Vec<Floats>;

// How often the count is compared with what can still be reached.
constexpr size_t kBlock = 512;
constexpr int kNearHalfWidth = 2;

// Distances in the largest window, and what is written behind them.
constexpr size_t kMaxWindow = 15 * 15 + 2 * kKernelPadding;

int CountPlaneInliers(const float* x, const float* y, const float* values, size_t num, float a,
                      float b, float c, float band, int max_uncounted) {
  const Floats f;
  const auto va = hn::Set(f, a), vb = hn::Set(f, b), vc = hn::Set(f, c), limit = hn::Set(f, band);
  size_t count = 0;
  for (size_t begin = 0; begin < num; begin += kBlock) {
    if (count + (num - begin) <= static_cast<size_t>(max_uncounted)) return 0;
    const size_t end = HWY_MIN(num, begin + kBlock);
    for (size_t i = begin; i < end; i += hn::Lanes(f)) {
      const auto value = hn::LoadU(f, values + i);
      const auto row = hn::Add(hn::Mul(vb, hn::LoadU(f, y + i)), vc);
      const auto plane = hn::Add(hn::Mul(va, hn::LoadU(f, x + i)), row);
      const auto is_inlier =
          hn::And(hn::Gt(value, hn::Zero(f)), hn::Le(hn::Abs(hn::Sub(value, plane)), limit));
      count += hn::CountTrue(f, is_inlier);
    }
  }
  return static_cast<int>(count);
}

void MarkPlaneInliers(const float* x, const float* values, size_t num, float a, float row,
                      float band, uint8_t* marked) {
  const Floats f;
  const Ints i32;
  const Bytes bytes;
  const auto va = hn::Set(f, a), vrow = hn::Set(f, row), limit = hn::Set(f, band);
  for (size_t begin = 0; begin < num; begin += hn::Lanes(f)) {
    const size_t u = HWY_MIN(begin, num - hn::Lanes(f));
    const auto value = hn::LoadU(f, values + u);
    const auto residual = hn::Sub(value, hn::Add(hn::Mul(va, hn::LoadU(f, x + u)), vrow));
    const auto is_inlier = hn::And(hn::Gt(value, hn::Zero(f)), hn::Le(hn::Abs(residual), limit));
    const auto one = hn::IfThenElseZero(hn::RebindMask(i32, is_inlier), hn::Set(i32, 1));
    hn::StoreU(hn::DemoteTo(bytes, one), bytes, marked + u);
  }
}

void MarkAmid(const uint8_t* above, const uint8_t* middle, const uint8_t* below, size_t num,
              int min_marked, uint8_t* marked) {
  const hn::CappedTag<uint8_t, kKernelPadding> u8;
  const auto least = hn::Set(u8, static_cast<uint8_t>(min_marked));
  for (size_t begin = 1; begin + 1 < num; begin += hn::Lanes(u8)) {
    const size_t u = HWY_MIN(begin, num - 1 - hn::Lanes(u8));
    auto sum = hn::Zero(u8);
    for (const uint8_t* row : {above + u, middle + u, below + u}) {
      sum = hn::Add(sum, hn::Add(hn::LoadU(u8, row - 1),
                                 hn::Add(hn::LoadU(u8, row), hn::LoadU(u8, row + 1))));
    }
    const auto is_amid = hn::Eq(hn::Max(sum, least), sum);
    hn::StoreU(hn::IfThenElseZero(is_amid, hn::LoadU(u8, middle + u)), u8, marked + u);
  }
}

void ClassifyHeights(const float* x, const float* values, size_t num, float a, float row,
                     const HeightLimits& limits, uint8_t* classes) {
  const Floats f;
  const Ints i32;
  const Bytes bytes;
  const auto va = hn::Set(f, a), vrow = hn::Set(f, row);
  for (size_t begin = 0; begin < num; begin += hn::Lanes(f)) {
    const size_t u = HWY_MIN(begin, num - hn::Lanes(f));
    const auto value = hn::LoadU(f, values + u);
    const auto residual = hn::Sub(value, hn::Add(hn::Mul(va, hn::LoadU(f, x + u)), vrow));
    const auto above = [&](float least_residual, float slope) {
      return hn::Gt(residual,
                    hn::Max(hn::Set(f, least_residual), hn::Mul(hn::Set(f, slope), value)));
    };
    const auto is_foot =
        hn::And(hn::And(hn::Gt(value, hn::Zero(f)),
                        hn::Lt(residual, hn::Mul(hn::Set(f, limits.max_slope), value))),
                above(limits.foot_residual, limits.foot_slope));
    const auto is_object = above(limits.object_residual, limits.object_slope);
    const auto foot = hn::IfThenElseZero(hn::RebindMask(i32, is_foot), hn::Set(i32, 1));
    const auto both =
        hn::IfThenElseZero(hn::RebindMask(i32, hn::And(is_foot, is_object)), hn::Set(i32, 1));
    hn::StoreU(hn::DemoteTo(bytes, hn::Add(foot, both)), bytes, classes + u);
  }
}

void MarkContained(const float* x, float y, const float* values, const uint8_t* marked, size_t num,
                   const RegionView& region, uint8_t* contained) {
  const Floats f;
  const Ints i32;
  const Bytes bytes;
  const auto along = [&](const float* axis, const Vector& ray_x, const Vector& z) {
    const auto xy = hn::Add(hn::Mul(hn::Set(f, axis[0]), ray_x), hn::Set(f, axis[1] * y));
    return hn::Mul(z, hn::Add(xy, hn::Set(f, axis[2])));
  };
  for (size_t begin = 0; begin < num; begin += hn::Lanes(f)) {
    const size_t u = HWY_MIN(begin, num - hn::Lanes(f));
    auto inside =
        hn::RebindMask(f, hn::Gt(hn::PromoteTo(i32, hn::LoadU(bytes, marked + u)), hn::Zero(i32)));
    hn::StoreU(hn::Zero(bytes), bytes, contained + u);
    if (region.num_edges == 0 || hn::AllFalse(f, inside)) continue;
    const auto z = hn::Div(hn::Set(f, 1.0f), hn::LoadU(f, values + u));
    const auto ray_x = hn::LoadU(f, x + u);
    const auto plane_x = along(region.x_axis, ray_x, z);
    const auto plane_y = along(region.y_axis, ray_x, z);
    for (size_t e = 0; e < region.num_edges && !hn::AllFalse(f, inside); ++e) {
      const float* edge = region.edges + 3 * e;
      const auto offset = hn::Add(
          hn::Add(hn::Mul(hn::Set(f, edge[0]), plane_x), hn::Mul(hn::Set(f, edge[1]), plane_y)),
          hn::Set(f, edge[2]));
      inside = hn::And(inside, hn::Ge(offset, hn::Zero(f)));
    }
    const auto one = hn::IfThenElseZero(hn::RebindMask(i32, inside), hn::Set(i32, 1));
    hn::StoreU(hn::DemoteTo(bytes, one), bytes, contained + u);
  }
}

// Adds the near points of row dv, columns first to last but 0 in the middle row, to the counts.
HWY_INLINE void CountRow(const PointWindow& window, size_t u, int dv, int first, int last,
                         float limit_square, const Vector& value, hn::Vec<Ints>& count) {
  const Floats f;
  const Ints i32;
  const auto x = hn::LoadU(f, window.x + u);
  const auto y = hn::Set(f, window.y[0]), other_y = hn::Set(f, window.y[dv]);
  const float* others = window.values + dv * window.stride + static_cast<ptrdiff_t>(u);
  for (int du = first; du <= last; ++du) {
    if (du == 0 && dv == 0) continue;
    const auto other = hn::LoadU(f, others + du);
    const auto other_x = hn::LoadU(f, window.x + static_cast<ptrdiff_t>(u) + du);
    const auto dx = hn::Sub(hn::Mul(other_x, value), hn::Mul(x, other));
    const auto dy = hn::Sub(hn::Mul(other_y, value), hn::Mul(y, other));
    const auto dz = hn::Sub(value, other);
    const auto square = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
    const auto limit = hn::Mul(hn::Mul(hn::Set(f, limit_square), other), other);
    // A missing point is at 0 and never near.
    const auto is_near = hn::RebindMask(i32, hn::Lt(square, limit));
    count = hn::IfThenElse(is_near, hn::Add(count, hn::Set(i32, 1)), count);
  }
}

void CountNear(const PointWindow& window, size_t num, int half, float limit, int enough,
               int32_t* counts) {
  const Floats f;
  const Ints i32;
  const float limit_square = limit * limit;
  for (size_t u = 0; u < num; u += hn::Lanes(f)) {
    const auto value = hn::LoadU(f, window.values + u);
    const auto is_point = hn::Gt(value, hn::Zero(f));
    auto count = hn::Zero(i32);
    hn::StoreU(count, i32, counts + u);
    if (hn::AllFalse(f, is_point)) continue;
    const auto has_open = [&] {
      const auto is_short = hn::Lt(count, hn::Set(i32, enough));
      return !hn::AllFalse(i32, hn::And(hn::RebindMask(i32, is_point), is_short));
    };
    const auto count_row = [&](int dv, int first, int last) {
      CountRow(window, u, dv, first, last, limit_square, value, count);
    };
    // As far as needed: nearly all points have enough within these three rows.
    for (const int dv : {-1, 0, 1}) count_row(dv, -kNearHalfWidth, kNearHalfWidth);
    if (has_open()) {
      for (const int dv : {-kNearHalfWidth, kNearHalfWidth}) {
        count_row(dv, -kNearHalfWidth, kNearHalfWidth);
      }
    }
    if (half > kNearHalfWidth && has_open()) {
      for (int dv = kNearHalfWidth + 1; dv <= half; ++dv) {
        count_row(-dv, -half, half);
        count_row(dv, -half, half);
      }
    }
    if (half > kNearHalfWidth && has_open()) {
      for (int dv = -kNearHalfWidth; dv <= kNearHalfWidth; ++dv) {
        count_row(dv, -half, -kNearHalfWidth - 1);
        count_row(dv, kNearHalfWidth + 1, half);
      }
    }
    hn::StoreU(hn::Min(count, hn::Set(i32, enough)), i32, counts + u);
  }
}

// Squared distances from one point to the others in its window, over its squared depth, then
// infinities. Returns how many distances there are.
HWY_INLINE size_t SquaredDistances(const PointWindow& window, size_t u, int half, float* squares) {
  const Floats f;
  const float* center = window.values + u;
  const float* ray_x = window.x + u;
  const auto value = hn::Set(f, *center), x = hn::Set(f, *ray_x), y = hn::Set(f, *window.y);
  size_t num = 0;
  for (int dv = -half; dv <= half; ++dv) {
    const auto other_y = hn::Set(f, window.y[dv]);
    for (int du = -half; du <= half; du += static_cast<int>(hn::Lanes(f))) {
      const auto other = hn::LoadU(f, center + dv * window.stride + du);
      const auto in_window = hn::FirstN(f, static_cast<size_t>(half - du + 1));
      auto is_other = hn::And(in_window, hn::Gt(other, hn::Zero(f)));
      if (dv == 0)
        is_other = hn::And(is_other, hn::Ne(hn::Iota(f, static_cast<float>(du)), hn::Zero(f)));
      const auto dx = hn::Sub(hn::Mul(hn::LoadU(f, ray_x + du), value), hn::Mul(x, other));
      const auto dy = hn::Sub(hn::Mul(other_y, value), hn::Mul(y, other));
      const auto dz = hn::Sub(value, other);
      const auto square = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
      const auto relative = hn::Div(square, hn::Mul(other, other));
      hn::StoreU(Packing<Floats>(f, is_other)(relative), f, squares + num);
      num += hn::CountTrue(f, is_other);
    }
  }
  for (size_t i = 0; i < hn::Lanes(f); ++i) squares[num + i] = hwy::HighestValue<float>();
  return num;
}

// Keeps the values of the part that holds the rank-th smallest, rank at most num: up to low, from
// there up to high, or above. Infinities follow. Returns how many are kept; *rank becomes the
// value's rank among them.
HWY_INLINE size_t KeepPart(const float* values, size_t num, float low, float high, float* kept,
                           size_t* rank) {
  const Floats f;
  size_t num_low = 0, num_high = 0;
  for (size_t i = 0; i < num; i += hn::Lanes(f)) {
    const auto value = hn::LoadU(f, values + i);
    num_low += hn::CountTrue(f, hn::Le(value, hn::Set(f, low)));
    num_high += hn::CountTrue(f, hn::Le(value, hn::Set(f, high)));
  }
  constexpr float kInfinity = hwy::HighestValue<float>();
  const bool is_low = num_low >= *rank, is_high = num_high < *rank;
  const auto above = hn::Set(f, is_low ? -1.0f : is_high ? high : low);
  const auto below = hn::Set(f, is_low ? low : is_high ? kInfinity : high);
  *rank -= is_low ? 0 : is_high ? num_high : num_low;
  size_t num_kept = 0;
  for (size_t i = 0; i < num; i += hn::Lanes(f)) {
    const auto value = hn::LoadU(f, values + i);
    const auto is_kept = hn::And(hn::Gt(value, above), hn::Le(value, below));
    hn::StoreU(Packing<Floats>(f, is_kept)(value), f, kept + num_kept);
    num_kept += hn::CountTrue(f, is_kept);
  }
  hn::StoreU(hn::Set(f, kInfinity), f, kept + num_kept);
  return num_kept;
}

// The rank-th smallest value, rank at most num, faster for a good guess of it. Counts for each
// value those below it: no branch depends on data.
HWY_INLINE float ValueOfRank(const float* values, size_t num, size_t rank, float guess) {
  const Floats f;
  const Ints i32;
  float kept[kMaxWindow];
  num = KeepPart(values, num, guess, 2 * guess, kept, &rank);
  values = kept;
  auto largest = hn::Zero(f);
  for (size_t i = 0; i < num; i += hn::Lanes(f)) {
    const auto value = hn::LoadU(f, values + i);
    auto num_below = hn::Zero(i32);
    for (size_t j = 0; j < num; ++j) {
      const auto is_below = hn::RebindMask(i32, hn::Lt(hn::Set(f, values[j]), value));
      num_below = hn::Sub(num_below, hn::VecFromMask(i32, is_below));
    }
    const auto is_in = hn::Lt(num_below, hn::Set(i32, static_cast<int32_t>(rank)));
    largest = hn::Max(largest, hn::IfThenElseZero(hn::RebindMask(f, is_in), value));
  }
  return hn::GetLane(hn::MaxOfLanes(f, largest));
}

float MeanOfNearest(const PointWindow& window, size_t u, int half, size_t num_nearest,
                    float guess) {
  const Floats f;
  float squares[kMaxWindow];
  const size_t num = SquaredDistances(window, u, half, squares);
  if (num == 0) return HUGE_VALF;
  const float farthest = ValueOfRank(squares, num, HWY_MIN(num, num_nearest), guess * guess);
  // Those nearer than the farthest one of the rank; it stands for its equals and for missing ones.
  size_t num_nearer = 0;
  for (size_t i = 0; i < num; i += hn::Lanes(f)) {
    const auto square = hn::LoadU(f, squares + i);
    const auto is_nearer = hn::Lt(square, hn::Set(f, farthest));
    hn::StoreU(Packing<Floats>(f, is_nearer)(hn::Sqrt(square)), f, squares + num_nearer);
    num_nearer += hn::CountTrue(f, is_nearer);
  }
  float sum = 0;
  for (size_t i = 0; i < num_nearer; ++i) sum += squares[i];
  sum += std::sqrt(farthest) * static_cast<float>(num_nearest - num_nearer);
  return sum / static_cast<float>(num_nearest);
}

}  // namespace HWY_NAMESPACE
}  // namespace declutter
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace declutter {
namespace {

HWY_EXPORT(CountPlaneInliers);
HWY_EXPORT(MarkPlaneInliers);
HWY_EXPORT(MarkAmid);
HWY_EXPORT(ClassifyHeights);
HWY_EXPORT(MarkContained);
HWY_EXPORT(CountNear);
HWY_EXPORT(MeanOfNearest);

}  // namespace

int CountPlaneInliers(const float* x, const float* y, const float* values, size_t num, float a,
                      float b, float c, float band, int max_uncounted) {
  return HWY_DYNAMIC_DISPATCH(CountPlaneInliers)(x, y, values, num, a, b, c, band, max_uncounted);
}

// A row with fewer elements than a vector is copied into a longer one.
void MarkPlaneInliers(const float* x, const float* values, size_t num, float a, float row,
                      float band, uint8_t* marked) {
  const auto mark = HWY_DYNAMIC_DISPATCH(MarkPlaneInliers);
  if (num >= kKernelPadding) return mark(x, values, num, a, row, band, marked);
  std::array<float, kKernelPadding> wide_x{}, wide_values{};
  std::array<uint8_t, kKernelPadding> wide_marked{};
  std::copy_n(x, num, wide_x.begin());
  std::copy_n(values, num, wide_values.begin());
  mark(wide_x.data(), wide_values.data(), kKernelPadding, a, row, band, wide_marked.data());
  std::copy_n(wide_marked.begin(), num, marked);
}

void MarkAmid(const uint8_t* above, const uint8_t* middle, const uint8_t* below, size_t num,
              int min_marked, uint8_t* marked) {
  constexpr size_t kMinNum = kKernelPadding + 2;
  const auto mark = HWY_DYNAMIC_DISPATCH(MarkAmid);
  if (num >= kMinNum) return mark(above, middle, below, num, min_marked, marked);
  std::array<uint8_t, kMinNum> wide_above{}, wide_middle{}, wide_below{}, wide_marked{};
  std::copy_n(above, num, wide_above.begin());
  std::copy_n(middle, num, wide_middle.begin());
  std::copy_n(below, num, wide_below.begin());
  mark(wide_above.data(), wide_middle.data(), wide_below.data(), kMinNum, min_marked,
       wide_marked.data());
  if (num > 2) std::copy_n(wide_marked.begin() + 1, num - 2, marked + 1);
}

void ClassifyHeights(const float* x, const float* values, size_t num, float a, float row,
                     const HeightLimits& limits, uint8_t* classes) {
  const auto classify = HWY_DYNAMIC_DISPATCH(ClassifyHeights);
  if (num >= kKernelPadding) return classify(x, values, num, a, row, limits, classes);
  std::array<float, kKernelPadding> wide_x{}, wide_values{};
  std::array<uint8_t, kKernelPadding> wide_classes{};
  std::copy_n(x, num, wide_x.begin());
  std::copy_n(values, num, wide_values.begin());
  classify(wide_x.data(), wide_values.data(), kKernelPadding, a, row, limits, wide_classes.data());
  std::copy_n(wide_classes.begin(), num, classes);
}

void MarkContained(const float* x, float y, const float* values, const uint8_t* marked, size_t num,
                   const RegionView& region, uint8_t* contained) {
  const auto mark = HWY_DYNAMIC_DISPATCH(MarkContained);
  if (num >= kKernelPadding) return mark(x, y, values, marked, num, region, contained);
  std::array<float, kKernelPadding> wide_x{}, wide_values{};
  std::array<uint8_t, kKernelPadding> wide_marked{}, wide_contained{};
  std::copy_n(x, num, wide_x.begin());
  std::copy_n(values, num, wide_values.begin());
  std::copy_n(marked, num, wide_marked.begin());
  mark(wide_x.data(), y, wide_values.data(), wide_marked.data(), kKernelPadding, region,
       wide_contained.data());
  std::copy_n(wide_contained.begin(), num, contained);
}

void CountNear(const PointWindow& window, size_t num, int half, float limit, int enough,
               int32_t* counts) {
  HWY_DYNAMIC_DISPATCH(CountNear)(window, num, half, limit, enough, counts);
}

float MeanOfNearest(const PointWindow& window, size_t u, int half, size_t num_nearest,
                    float guess) {
  return HWY_DYNAMIC_DISPATCH(MeanOfNearest)(window, u, half, num_nearest, guess);
}

}  // namespace declutter
#endif
