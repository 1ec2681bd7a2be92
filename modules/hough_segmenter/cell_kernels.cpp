#include "modules/hough_segmenter/cell_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "modules/hough_segmenter/cell_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once for each target
#include <hwy/highway.h>

#include "modules/hough_segmenter/cell_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace declutter {
namespace HWY_NAMESPACE {

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
  ForEachVector(cells.num, [&](size_t i, size_t k, const auto& keep) HWY_ATTR {
    const auto support = hn::Mul(hn::LoadU(f, cells.weight + i), agreement_of(cells, i));
    sum.Add(0, k, keep(support));
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

void LineSupports(const CellView& cells, const LineShape* lines, size_t num, float min_cos,
                  float* supports) {
  for (size_t k = 0; k < num; ++k) {
    supports[k] = SumAgreements(cells, LineAgreement(lines[k], min_cos), min_cos);
  }
}

void CircleSupports(const CellView& cells, const CircleShape* circles, size_t num, float min_cos,
                    float* supports) {
  for (size_t k = 0; k < num; ++k) {
    supports[k] = SumAgreements(cells, CircleAgreement<false>(circles[k], min_cos), min_cos);
  }
}

size_t CopyMarked(const float* marks, size_t num, size_t num_fields, const float* from,
                  size_t from_stride, float* to, size_t to_stride) {
  const Floats f;
  size_t num_kept = 0;
  for (size_t i = 0; i < num; i += hn::Lanes(f)) {
    const auto is_kept = hn::And(LanesBelow(num, i), hn::Gt(hn::LoadU(f, marks + i), hn::Zero(f)));
    const size_t num_here = hn::CountTrue(f, is_kept);
    if (num_here == 0) continue;
    const Packing<Floats> pack(f, is_kept);
    for (size_t field = 0; field < num_fields; ++field) {
      const auto values = hn::LoadU(f, from + field * from_stride + i);
      hn::StoreU(pack(values), f, to + field * to_stride + num_kept);
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
  ForEachVector(num, [&](size_t i, size_t k, const auto& keep)
                         HWY_ATTR { sum.Add(0, k, keep(hn::LoadU(Floats(), values + i))); });
  return sum[0];
}

float SumOfProducts(const float* a, const float* b, size_t num) {
  const Floats f;
  Sums<1> sum;
  ForEachVector(num, [&](size_t i, size_t k, const auto& keep) HWY_ATTR {
    const auto product = hn::Mul(hn::LoadU(f, a + i), hn::LoadU(f, b + i));
    sum.Add(0, k, keep(product));
  });
  return sum[0];
}

float WeightBelow(const float* values, const float* weights, size_t num, float limit) {
  const Floats f;
  Sums<1> sum;
  ForEachVector(num, [&](size_t i, size_t k, const auto& keep) HWY_ATTR {
    const auto is_low = hn::Lt(hn::LoadU(f, values + i), hn::Set(f, limit));
    sum.Add(0, k, keep(hn::IfThenElseZero(is_low, hn::LoadU(f, weights + i))));
  });
  return sum[0];
}

}  // namespace HWY_NAMESPACE
}  // namespace declutter
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace declutter {
namespace {

HWY_EXPORT(LineAgreements);
HWY_EXPORT(CircleAgreements);
HWY_EXPORT(LineSupports);
HWY_EXPORT(CircleSupports);
HWY_EXPORT(CopyMarked);
HWY_EXPORT(RangeOf);
HWY_EXPORT(SumOf);
HWY_EXPORT(SumOfProducts);
HWY_EXPORT(WeightBelow);

}  // namespace

void Agreements(const CellView& cells, const LineShape& line, float min_cos, float* agreements) {
  HWY_DYNAMIC_DISPATCH(LineAgreements)(cells, line, min_cos, agreements);
}

void Agreements(const CellView& cells, const CircleShape& circle, float min_cos,
                float* agreements) {
  HWY_DYNAMIC_DISPATCH(CircleAgreements)(cells, circle, min_cos, agreements);
}

void Supports(const CellView& cells, const LineShape* lines, size_t num, float min_cos,
              float* supports) {
  HWY_DYNAMIC_DISPATCH(LineSupports)(cells, lines, num, min_cos, supports);
}

void Supports(const CellView& cells, const CircleShape* circles, size_t num, float min_cos,
              float* supports) {
  HWY_DYNAMIC_DISPATCH(CircleSupports)(cells, circles, num, min_cos, supports);
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

}  // namespace declutter
#endif
