#include "modules/hough_segmenter/sample_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "modules/hough_segmenter/sample_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once for each target
#include <hwy/highway.h>

#include <algorithm>

#include "modules/hough_segmenter/cell_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace declutter {
namespace HWY_NAMESPACE {

using Mask = hn::Mask<Floats>;

// Vectors of the plane.
struct Vector2 {
  Vector x, y;
};

HWY_INLINE Vector2 Load2(const SamplePairs& pairs, SamplePairs::Field x, SamplePairs::Field y,
                         size_t i) {
  return {hn::LoadU(Floats(), pairs.field(x) + i), hn::LoadU(Floats(), pairs.field(y) + i)};
}
HWY_INLINE Vector2 Add(const Vector2& a, const Vector2& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y)};
}
HWY_INLINE Vector2 Sub(const Vector2& a, const Vector2& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y)};
}
HWY_INLINE Vector2 Mul(const Vector& factor, const Vector2& a) {
  return {hn::Mul(factor, a.x), hn::Mul(factor, a.y)};
}
HWY_INLINE Vector Dot(const Vector2& a, const Vector2& b) {
  return hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y));
}
HWY_INLINE Vector Cross(const Vector2& a, const Vector2& b) {
  return hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x));
}
HWY_INLINE Vector Norm(const Vector2& a) { return hn::Sqrt(Dot(a, a)); }

// Samples with their normals, and the way from one to the other.
struct Pairs {
  Vector2 a, b, na, nb, ab;
};

// Of the pairs from i on.
HWY_INLINE Pairs LoadPairs(const SamplePairs& pairs, size_t i) {
  const Vector2 a = Load2(pairs, SamplePairs::kAx, SamplePairs::kAy, i);
  const Vector2 b = Load2(pairs, SamplePairs::kBx, SamplePairs::kBy, i);
  return {a, b, Load2(pairs, SamplePairs::kAnx, SamplePairs::kAny, i),
          Load2(pairs, SamplePairs::kBnx, SamplePairs::kBny, i), Sub(b, a)};
}

// Appends the models of the lanes in the mask, of three parameters each, to the first num ones.
template <typename Shape>
HWY_INLINE size_t Append(const Mask& is_model, const Vector& p0, const Vector& p1, const Vector& p2,
                         size_t num, Shape* models) {
  static_assert(sizeof(Shape) == 3 * sizeof(float));
  const Packing<Floats> pack(Floats(), is_model);
  hn::StoreInterleaved3(pack(p0), pack(p1), pack(p2), Floats(),
                        reinterpret_cast<float*>(models + num));
  return num + hn::CountTrue(Floats(), is_model);
}

size_t LinesThroughPairs(const SamplePairs& pairs, float min_cos, LineShape* lines) {
  const Floats f;
  const auto least_cos = hn::Set(f, min_cos);
  size_t num = 0;
  for (size_t i = 0; i < pairs.size(); i += kLanes) {
    const auto [a, b, na, nb, ab] = LoadPairs(pairs, i);
    const auto length = Norm(ab);
    Vector2 n{hn::Div(ab.y, length), hn::Neg(hn::Div(ab.x, length))};
    const auto is_inward = hn::Lt(Dot(n, Add(na, nb)), hn::Zero(f));
    n = {hn::IfThenElse(is_inward, hn::Neg(n.x), n.x),
         hn::IfThenElse(is_inward, hn::Neg(n.y), n.y)};
    const auto rho = hn::Mul(hn::Set(f, 0.5f), Dot(n, Add(a, b)));
    const auto agrees = hn::And(hn::Gt(Dot(n, na), least_cos), hn::Gt(Dot(n, nb), least_cos));
    num = Append(hn::And(LanesBelow(pairs.size(), i), agrees), n.x, n.y, rho, num, lines);
  }
  return num;
}

size_t CirclesThroughPairs(const SamplePairs& pairs, const Range& radii, CircleShape* circles) {
  const Floats f;
  const auto least_sine = hn::Set(f, 0.1f);
  const auto half = hn::Set(f, 0.5f);
  size_t num = 0;
  for (size_t i = 0; i < pairs.size(); i += kLanes) {
    const auto [a, b, na, nb, ab] = LoadPairs(pairs, i);
    // c = a - ra * na = b - rb * nb
    const auto sine = Cross(na, nb);
    const auto ra = hn::Div(hn::Neg(Cross(ab, nb)), sine);
    const auto rb = hn::Div(hn::Neg(Cross(ab, na)), sine);
    const auto r = hn::Mul(half, hn::Add(ra, rb));
    const Vector2 c = Mul(half, Sub(Add(Sub(a, Mul(r, na)), b), Mul(r, nb)));
    auto is_circle = hn::And(LanesBelow(pairs.size(), i), hn::Ge(hn::Abs(sine), least_sine));
    is_circle = hn::And(is_circle, hn::And(hn::Gt(ra, hn::Zero(f)), hn::Gt(rb, hn::Zero(f))));
    is_circle = hn::And(
        is_circle, hn::And(hn::Ge(r, hn::Set(f, radii.low)), hn::Le(r, hn::Set(f, radii.high))));
    const auto is_near = [&](const Vector2& p, SamplePairs::Field limit) HWY_ATTR {
      return hn::Le(hn::Abs(hn::Sub(Norm(Sub(p, c)), r)), hn::LoadU(f, pairs.field(limit) + i));
    };
    is_circle = hn::And(
        is_circle, hn::And(is_near(a, SamplePairs::kALimit), is_near(b, SamplePairs::kBLimit)));
    num = Append(is_circle, c.x, c.y, r, num, circles);
  }
  return num;
}

}  // namespace HWY_NAMESPACE
}  // namespace declutter
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace declutter {
namespace {

HWY_EXPORT(LinesThroughPairs);
HWY_EXPORT(CirclesThroughPairs);

}  // namespace

void SamplePairs::Add(const SampleCell& a, const SampleCell& b) {
  if (num_ + kCellBlock >= stride_) Grow();
  const float fields[kNumFields] = {a.x, a.y, a.nx, a.ny, a.limit, b.x, b.y, b.nx, b.ny, b.limit};
  for (size_t field = 0; field < kNumFields; ++field) {
    values_[field * stride_ + num_] = fields[field];
  }
  ++num_;
}

void SamplePairs::Grow() {
  const size_t stride = std::max(4 * kCellBlock, 2 * stride_);
  std::vector<float> values(kNumFields * stride, 0);
  for (size_t field = 0; field < kNumFields; ++field) {
    std::copy_n(values_.begin() + static_cast<std::ptrdiff_t>(field * stride_), num_,
                values.begin() + static_cast<std::ptrdiff_t>(field * stride));
  }
  values_ = std::move(values);
  stride_ = stride;
}

void LinesThrough(const SamplePairs& pairs, float min_cos, std::vector<LineShape>* lines) {
  lines->resize(pairs.size() + kCellBlock);
  lines->resize(HWY_DYNAMIC_DISPATCH(LinesThroughPairs)(pairs, min_cos, lines->data()));
}

void CirclesThrough(const SamplePairs& pairs, const Range& radii,
                    std::vector<CircleShape>* circles) {
  circles->resize(pairs.size() + kCellBlock);
  circles->resize(HWY_DYNAMIC_DISPATCH(CirclesThroughPairs)(pairs, radii, circles->data()));
}

}  // namespace declutter
#endif
