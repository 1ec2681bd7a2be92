#include "modules/hough_segmenter/point_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "modules/hough_segmenter/point_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once for each target
#include <hwy/highway.h>

#include "modules/hough_segmenter/cell_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace declutter {
namespace HWY_NAMESPACE {

PointSums SumPoints(const float* x, const float* y, const float* weights, size_t num,
                    float origin_x, float origin_y) {
  const Floats f;
  Sums<6> sums;
  ForEachVector(num, [&](size_t i, size_t k, const auto& keep) HWY_ATTR {
    const auto w = keep(hn::LoadU(f, weights + i));
    const auto qx = hn::Sub(hn::LoadU(f, x + i), hn::Set(f, origin_x));
    const auto qy = hn::Sub(hn::LoadU(f, y + i), hn::Set(f, origin_y));
    const auto wx = hn::Mul(w, qx), wy = hn::Mul(w, qy);
    sums.Add(0, k, w);
    sums.Add(1, k, wx);
    sums.Add(2, k, wy);
    sums.Add(3, k, hn::Mul(wx, qx));
    sums.Add(4, k, hn::Mul(wx, qy));
    sums.Add(5, k, hn::Mul(wy, qy));
  });
  return {sums[0], sums[1], sums[2], sums[3], sums[4], sums[5]};
}

CircleSums SumCircle(const float* x, const float* y, const float* weights, size_t num,
                     const CircleShape& circle) {
  const Floats f;
  Sums<9> sums;
  ForEachVector(num, [&](size_t i, size_t k, const auto& keep) HWY_ATTR {
    const auto w = keep(hn::LoadU(f, weights + i));
    const auto dx = hn::Sub(hn::LoadU(f, x + i), hn::Set(f, circle.cx));
    const auto dy = hn::Sub(hn::LoadU(f, y + i), hn::Set(f, circle.cy));
    const auto square = hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy));
    const auto d = hn::Sqrt(hn::Add(square, hn::Set(f, kLeastSquaredDistance)));
    const auto inverse = hn::Div(hn::Set(f, 1.0f), d);
    const auto ux = hn::Mul(dx, inverse), uy = hn::Mul(dy, inverse);
    const auto wx = hn::Mul(w, ux), wy = hn::Mul(w, uy);
    const auto e = hn::Sub(d, hn::Set(f, circle.r));
    sums.Add(0, k, w);
    sums.Add(1, k, wx);
    sums.Add(2, k, wy);
    sums.Add(3, k, hn::Mul(wx, ux));
    sums.Add(4, k, hn::Mul(wx, uy));
    sums.Add(5, k, hn::Mul(wy, uy));
    sums.Add(6, k, hn::Mul(w, e));
    sums.Add(7, k, hn::Mul(wx, e));
    sums.Add(8, k, hn::Mul(wy, e));
  });
  return {sums[0], sums[1], sums[2], sums[3], sums[4], sums[5], sums[6], sums[7], sums[8]};
}

Range RangeAlong(const float* x, const float* y, size_t num, float tx, float ty) {
  const Floats f;
  const auto first = hn::Set(f, tx * x[0] + ty * y[0]);
  auto low = first, high = first;
  for (size_t i = 0; i < num; i += kLanes) {
    const auto along = hn::Add(hn::Mul(hn::Set(f, tx), hn::LoadU(f, x + i)),
                               hn::Mul(hn::Set(f, ty), hn::LoadU(f, y + i)));
    const auto s = hn::IfThenElse(LanesBelow(num, i), along, first);
    low = hn::Min(low, s);
    high = hn::Max(high, s);
  }
  return {hn::GetLane(hn::MinOfLanes(f, low)), hn::GetLane(hn::MaxOfLanes(f, high))};
}

void PositionsAlong(const float* x, const float* y, size_t num, float tx, float ty,
                    float* positions) {
  const Floats f;
  for (size_t i = 0; i < num; i += hn::Lanes(f)) {
    const auto s = hn::Add(hn::Mul(hn::Set(f, tx), hn::LoadU(f, x + i)),
                           hn::Mul(hn::Set(f, ty), hn::LoadU(f, y + i)));
    hn::StoreU(s, f, positions + i);
  }
}

// Polynomial 4.4.49 of Abramowitz and Stegun for the arc tangent in [0, 1], the rest by symmetry.
HWY_INLINE Vector Angle(const Vector& y, const Vector& x) {
  constexpr float kHalfTurn = 3.14159265358979f;
  const Floats f;
  const auto abs_x = hn::Abs(x), abs_y = hn::Abs(y);
  const auto larger = hn::Max(hn::Max(abs_x, abs_y), hn::Set(f, 1e-20f));
  const auto t = hn::Div(hn::Min(abs_x, abs_y), larger);
  const auto t2 = hn::Mul(t, t);
  auto sum = hn::Set(f, 0.0208351f);
  for (const float coefficient : {-0.0851330f, 0.1801410f, -0.3302995f, 0.9998660f}) {
    sum = hn::Add(hn::Mul(sum, t2), hn::Set(f, coefficient));
  }
  auto angle = hn::Mul(sum, t);
  angle = hn::IfThenElse(hn::Gt(abs_y, abs_x), hn::Sub(hn::Set(f, 0.5f * kHalfTurn), angle), angle);
  angle = hn::IfThenElse(hn::Lt(x, hn::Zero(f)), hn::Sub(hn::Set(f, kHalfTurn), angle), angle);
  return hn::CopySignToAbs(angle, y);
}

void Distances(const float* x, const float* y, size_t num, float cx, float cy, float* distances) {
  const Floats f;
  for (size_t i = 0; i < num; i += hn::Lanes(f)) {
    const auto dx = hn::Sub(hn::LoadU(f, x + i), hn::Set(f, cx));
    const auto dy = hn::Sub(hn::LoadU(f, y + i), hn::Set(f, cy));
    hn::StoreU(hn::Sqrt(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy))), f, distances + i);
  }
}

void Angles(const float* x, const float* y, size_t num, float cx, float cy, float ax, float ay,
            float* angles) {
  const Floats f;
  const auto vax = hn::Set(f, ax), vay = hn::Set(f, ay);
  for (size_t i = 0; i < num; i += hn::Lanes(f)) {
    const auto dx = hn::Sub(hn::LoadU(f, x + i), hn::Set(f, cx));
    const auto dy = hn::Sub(hn::LoadU(f, y + i), hn::Set(f, cy));
    const auto along = hn::Add(hn::Mul(vax, dx), hn::Mul(vay, dy));
    const auto across = hn::Sub(hn::Mul(vax, dy), hn::Mul(vay, dx));
    hn::StoreU(Angle(across, along), f, angles + i);
  }
}

size_t CountInside(const float* x, const float* y, size_t num, const CircleShape& circle) {
  const Floats f;
  const auto squared_radius = hn::Set(f, circle.r * circle.r);
  size_t num_inside = 0;
  for (size_t i = 0; i < num; i += hn::Lanes(f)) {
    const auto dx = hn::Sub(hn::LoadU(f, x + i), hn::Set(f, circle.cx));
    const auto dy = hn::Sub(hn::LoadU(f, y + i), hn::Set(f, circle.cy));
    const auto is_inside = hn::Lt(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), squared_radius);
    num_inside += hn::CountTrue(f, hn::And(LanesBelow(num, i), is_inside));
  }
  return num_inside;
}

RingCount CountOnRing(const float* x, const float* y, size_t num, const CircleShape& circle,
                      float tolerance) {
  const Floats f;
  const auto square_of = [&](float radius)
                             HWY_ATTR { return hn::Set(f, radius > 0 ? radius * radius : 0.0f); };
  const auto outer = square_of(circle.r + tolerance), inner = square_of(circle.r - tolerance),
             inside = square_of(circle.r - 2 * tolerance);
  const auto cx = hn::Set(f, circle.cx), cy = hn::Set(f, circle.cy);
  size_t num_on = 0, num_inside = 0;
  for (size_t i = 0; i < num; i += hn::Lanes(f)) {
    const auto dx = hn::Sub(hn::LoadU(f, x + i), cx), dy = hn::Sub(hn::LoadU(f, y + i), cy);
    const auto square = hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy));
    const auto mask = LanesBelow(num, i);
    num_on +=
        hn::CountTrue(f, hn::And(mask, hn::And(hn::Gt(square, inner), hn::Lt(square, outer))));
    num_inside += hn::CountTrue(f, hn::And(mask, hn::Lt(square, inside)));
  }
  return {static_cast<int>(num_on), static_cast<int>(num_inside)};
}

}  // namespace HWY_NAMESPACE
}  // namespace declutter
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace declutter {
namespace {

HWY_EXPORT(SumPoints);
HWY_EXPORT(SumCircle);
HWY_EXPORT(RangeAlong);
HWY_EXPORT(PositionsAlong);
HWY_EXPORT(Distances);
HWY_EXPORT(Angles);
HWY_EXPORT(CountInside);
HWY_EXPORT(CountOnRing);

}  // namespace

PointSums SumPoints(const float* x, const float* y, const float* weights, size_t num,
                    float origin_x, float origin_y) {
  return HWY_DYNAMIC_DISPATCH(SumPoints)(x, y, weights, num, origin_x, origin_y);
}

CircleSums SumCircle(const float* x, const float* y, const float* weights, size_t num,
                     const CircleShape& circle) {
  return HWY_DYNAMIC_DISPATCH(SumCircle)(x, y, weights, num, circle);
}

Range RangeAlong(const float* x, const float* y, size_t num, float tx, float ty) {
  return HWY_DYNAMIC_DISPATCH(RangeAlong)(x, y, num, tx, ty);
}

void PositionsAlong(const float* x, const float* y, size_t num, float tx, float ty,
                    float* positions) {
  HWY_DYNAMIC_DISPATCH(PositionsAlong)(x, y, num, tx, ty, positions);
}

void Distances(const float* x, const float* y, size_t num, float cx, float cy, float* distances) {
  HWY_DYNAMIC_DISPATCH(Distances)(x, y, num, cx, cy, distances);
}

void Angles(const float* x, const float* y, size_t num, float cx, float cy, float ax, float ay,
            float* angles) {
  HWY_DYNAMIC_DISPATCH(Angles)(x, y, num, cx, cy, ax, ay, angles);
}

size_t CountInside(const float* x, const float* y, size_t num, const CircleShape& circle) {
  return HWY_DYNAMIC_DISPATCH(CountInside)(x, y, num, circle);
}

RingCount CountOnRing(const float* x, const float* y, size_t num, const CircleShape& circle,
                      float tolerance) {
  return HWY_DYNAMIC_DISPATCH(CountOnRing)(x, y, num, circle, tolerance);
}

}  // namespace declutter
#endif
