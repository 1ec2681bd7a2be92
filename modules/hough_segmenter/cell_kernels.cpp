#include "modules/hough_segmenter/cell_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "modules/hough_segmenter/cell_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once for each target
#include <hwy/highway.h>

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

HWY_INLINE Vector Agreement(const CellView& cells, size_t i, const Vector& squared_distance,
                            const Vector& cosine, const Vector& min_cos) {
  const Floats f;
  const auto one = hn::Set(f, 1.0f);
  const auto nearness = hn::Max(
      hn::Zero(f), hn::Sub(one, hn::Mul(squared_distance, hn::LoadU(f, cells.inverse_limit + i))));
  return hn::Mul(nearness, hn::Max(hn::Zero(f), hn::Sub(cosine, min_cos)));
}

// Agreement of cells times 1 - min_cos.
struct LineAgreement {
  HWY_INLINE LineAgreement(const LineShape& line, float least_cos)
      : nx(hn::Set(Floats(), line.nx)),
        ny(hn::Set(Floats(), line.ny)),
        rho(hn::Set(Floats(), line.rho)),
        min_cos(hn::Set(Floats(), least_cos)) {}

  HWY_INLINE Vector operator()(const CellView& cells, size_t i) const {
    const Floats f;
    const auto along =
        hn::Add(hn::Mul(nx, hn::LoadU(f, cells.x + i)), hn::Mul(ny, hn::LoadU(f, cells.y + i)));
    const auto distance = hn::Sub(along, rho);
    const auto cosine =
        hn::Add(hn::Mul(nx, hn::LoadU(f, cells.nx + i)), hn::Mul(ny, hn::LoadU(f, cells.ny + i)));
    return Agreement(cells, i, hn::Mul(distance, distance), cosine, min_cos);
  }

  Vector nx, ny, rho, min_cos;
};

template <bool kIsExact>
struct CircleAgreement {
  HWY_INLINE CircleAgreement(const CircleShape& circle, float least_cos)
      : cx(hn::Set(Floats(), circle.cx)),
        cy(hn::Set(Floats(), circle.cy)),
        r(hn::Set(Floats(), circle.r)),
        inverse_r(hn::Set(Floats(), 1 / circle.r)),
        min_cos(hn::Set(Floats(), least_cos)) {}

  HWY_INLINE Vector operator()(const CellView& cells, size_t i) const {
    const Floats f;
    const auto dx = hn::Sub(hn::LoadU(f, cells.x + i), cx);
    const auto dy = hn::Sub(hn::LoadU(f, cells.y + i), cy);
    const auto square = hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy));
    const auto dot =
        hn::Add(hn::Mul(dx, hn::LoadU(f, cells.nx + i)), hn::Mul(dy, hn::LoadU(f, cells.ny + i)));
    if (kIsExact) {
      const auto radial = hn::Sqrt(hn::Add(square, hn::Set(f, kLeastSquaredDistance)));
      const auto distance = hn::Sub(radial, r);
      return Agreement(cells, i, hn::Mul(distance, distance), hn::Div(dot, radial), min_cos);
    }
    const auto distance =
        hn::Mul(hn::Sub(square, hn::Mul(r, r)), hn::Mul(hn::Set(f, 0.5f), inverse_r));
    return Agreement(cells, i, hn::Mul(distance, distance), hn::Mul(dot, inverse_r), min_cos);
  }

  Vector cx, cy, r, inverse_r, min_cos;
};

template <typename AgreementOf>
HWY_INLINE void StoreAgreements(const CellView& cells, const AgreementOf& agreement_of,
                                float min_cos, float* agreements) {
  const Floats f;
  const auto scale = hn::Set(f, 1 / (1 - min_cos));
  for (size_t i = 0; i < cells.num; i += hn::Lanes(f)) {
    const auto is_there = hn::Gt(hn::LoadU(f, cells.weight + i), hn::Zero(f));
    const auto agreement = hn::Mul(agreement_of(cells, i), scale);
    hn::StoreU(hn::IfThenElseZero(is_there, agreement), f, agreements + i);
  }
}

template <typename AgreementOf>
HWY_INLINE float SumAgreements(const CellView& cells, const AgreementOf& agreement_of,
                               float min_cos) {
  const Floats f;
  Sums<1> sum;
  ForEachVector(cells.num, [&](size_t i, const auto& mask, size_t k) HWY_ATTR {
    const auto support = hn::Mul(hn::LoadU(f, cells.weight + i), agreement_of(cells, i));
    sum.Add(0, k, hn::IfThenElseZero(mask, support));
  });
  return sum[0] / (1 - min_cos);
}

void LineAgreements(const CellView& cells, const LineShape& line, float min_cos,
                    float* agreements) {
  StoreAgreements(cells, LineAgreement(line, min_cos), min_cos, agreements);
}

void CircleAgreements(const CellView& cells, const CircleShape& circle, float min_cos,
                      float* agreements) {
  StoreAgreements(cells, CircleAgreement<true>(circle, min_cos), min_cos, agreements);
}

float LineSupport(const CellView& cells, const LineShape& line, float min_cos) {
  return SumAgreements(cells, LineAgreement(line, min_cos), min_cos);
}

float CircleSupport(const CellView& cells, const CircleShape& circle, float min_cos) {
  return SumAgreements(cells, CircleAgreement<false>(circle, min_cos), min_cos);
}

size_t CopyMarked(const float* marks, size_t num, size_t num_fields, const float* from,
                  size_t from_stride, float* to, size_t to_stride) {
  const Floats f;
  const hn::RebindToSigned<Floats> i32;
  size_t num_kept = 0;
  for (size_t i = 0; i < num; i += hn::Lanes(f)) {
    const auto is_kept = hn::And(LanesBelow(num, i), hn::Gt(hn::LoadU(f, marks + i), hn::Zero(f)));
    const size_t num_here = hn::CountTrue(f, is_kept);
    if (num_here == 0) continue;
    const auto kept_lanes =
        hn::IndicesFromVec(f, hn::Compress(hn::Iota(i32, 0), hn::RebindMask(i32, is_kept)));
    for (size_t field = 0; field < num_fields; ++field) {
      const auto values = hn::LoadU(f, from + field * from_stride + i);
      hn::StoreU(hn::TableLookupLanes(values, kept_lanes), f, to + field * to_stride + num_kept);
    }
    num_kept += num_here;
  }
  return num_kept;
}

Range RangeOf(const float* values, size_t num) {
  const Floats f;
  const size_t lanes = hn::Lanes(f);
  Range range{values[0], values[0]};
  size_t i = 0;
  if (num >= lanes) {
    auto low = hn::LoadU(f, values), high = low;
    for (i = lanes; i + lanes <= num; i += lanes) {
      const auto value = hn::LoadU(f, values + i);
      low = hn::Min(low, value);
      high = hn::Max(high, value);
    }
    range = {hn::GetLane(hn::MinOfLanes(f, low)), hn::GetLane(hn::MaxOfLanes(f, high))};
  }
  for (; i < num; ++i) {
    range = {HWY_MIN(range.low, values[i]), HWY_MAX(range.high, values[i])};
  }
  return range;
}

float SumOf(const float* values, size_t num) {
  Sums<1> sum;
  ForEachVector(num, [&](size_t i, const auto& mask, size_t k) HWY_ATTR {
    sum.Add(0, k, hn::IfThenElseZero(mask, hn::LoadU(Floats(), values + i)));
  });
  return sum[0];
}

float SumOfProducts(const float* a, const float* b, size_t num) {
  const Floats f;
  Sums<1> sum;
  ForEachVector(num, [&](size_t i, const auto& mask, size_t k) HWY_ATTR {
    const auto product = hn::Mul(hn::LoadU(f, a + i), hn::LoadU(f, b + i));
    sum.Add(0, k, hn::IfThenElseZero(mask, product));
  });
  return sum[0];
}

float WeightBelow(const float* values, const float* weights, size_t num, float limit) {
  const Floats f;
  Sums<1> sum;
  ForEachVector(num, [&](size_t i, const auto& mask, size_t k) HWY_ATTR {
    const auto is_low = hn::Lt(hn::LoadU(f, values + i), hn::Set(f, limit));
    sum.Add(0, k, hn::IfThenElseZero(hn::And(mask, is_low), hn::LoadU(f, weights + i)));
  });
  return sum[0];
}

PointSums SumPoints(const float* x, const float* y, const float* weights, size_t num,
                    float origin_x, float origin_y) {
  const Floats f;
  Sums<6> sums;
  ForEachVector(num, [&](size_t i, const auto& mask, size_t k) HWY_ATTR {
    const auto w = hn::IfThenElseZero(mask, hn::LoadU(f, weights + i));
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
  ForEachVector(num, [&](size_t i, const auto& mask, size_t k) HWY_ATTR {
    const auto w = hn::IfThenElseZero(mask, hn::LoadU(f, weights + i));
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

HWY_EXPORT(LineAgreements);
HWY_EXPORT(CircleAgreements);
HWY_EXPORT(LineSupport);
HWY_EXPORT(CircleSupport);
HWY_EXPORT(CopyMarked);
HWY_EXPORT(RangeOf);
HWY_EXPORT(SumOf);
HWY_EXPORT(SumOfProducts);
HWY_EXPORT(WeightBelow);
HWY_EXPORT(SumPoints);
HWY_EXPORT(SumCircle);
HWY_EXPORT(PositionsAlong);
HWY_EXPORT(Distances);
HWY_EXPORT(Angles);
HWY_EXPORT(CountOnRing);

}  // namespace

void Agreements(const CellView& cells, const LineShape& line, float min_cos, float* agreements) {
  HWY_DYNAMIC_DISPATCH(LineAgreements)(cells, line, min_cos, agreements);
}

void Agreements(const CellView& cells, const CircleShape& circle, float min_cos,
                float* agreements) {
  HWY_DYNAMIC_DISPATCH(CircleAgreements)(cells, circle, min_cos, agreements);
}

float Support(const CellView& cells, const LineShape& line, float min_cos) {
  return HWY_DYNAMIC_DISPATCH(LineSupport)(cells, line, min_cos);
}

float Support(const CellView& cells, const CircleShape& circle, float min_cos) {
  return HWY_DYNAMIC_DISPATCH(CircleSupport)(cells, circle, min_cos);
}

size_t CopyMarked(const float* marks, size_t num, size_t num_fields, const float* from,
                  size_t from_stride, float* to, size_t to_stride) {
  return HWY_DYNAMIC_DISPATCH(CopyMarked)(marks, num, num_fields, from, from_stride, to, to_stride);
}

Range RangeOf(const float* values, size_t num) {
  return HWY_DYNAMIC_DISPATCH(RangeOf)(values, num);
}

float SumOf(const float* values, size_t num) { return HWY_DYNAMIC_DISPATCH(SumOf)(values, num); }

float SumOfProducts(const float* a, const float* b, size_t num) {
  return HWY_DYNAMIC_DISPATCH(SumOfProducts)(a, b, num);
}

float WeightBelow(const float* values, const float* weights, size_t num, float limit) {
  return HWY_DYNAMIC_DISPATCH(WeightBelow)(values, weights, num, limit);
}

PointSums SumPoints(const float* x, const float* y, const float* weights, size_t num,
                    float origin_x, float origin_y) {
  return HWY_DYNAMIC_DISPATCH(SumPoints)(x, y, weights, num, origin_x, origin_y);
}

CircleSums SumCircle(const float* x, const float* y, const float* weights, size_t num,
                     const CircleShape& circle) {
  return HWY_DYNAMIC_DISPATCH(SumCircle)(x, y, weights, num, circle);
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

RingCount CountOnRing(const float* x, const float* y, size_t num, const CircleShape& circle,
                      float tolerance) {
  return HWY_DYNAMIC_DISPATCH(CountOnRing)(x, y, num, circle, tolerance);
}

}  // namespace declutter
#endif
