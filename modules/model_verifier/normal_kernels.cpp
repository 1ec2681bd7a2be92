#include "modules/model_verifier/normal_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "modules/model_verifier/normal_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once for each target
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace declutter {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, kNormalMargin_px>;
using Ints = hn::RebindToSigned<Floats>;
using Vector = hn::Vec<Floats>;

void MeanInverseDepths(const float* above, const float* middle, const float* below, size_t num,
                       float max_jump, float* means) {
  const Floats f;
  const auto limit = hn::Set(f, max_jump), one = hn::Set(f, 1.0f);
  for (size_t u = 1; u + 1 < num; u += hn::Lanes(f)) {
    const auto center = hn::LoadU(f, middle + u);
    auto sum = hn::Zero(f), count = hn::Zero(f);
    for (const float* row : {above, middle, below}) {
      for (const float* from : {row + u - 1, row + u, row + u + 1}) {
        const auto value = hn::LoadU(f, from);
        const auto is_near =
            hn::And(hn::Gt(value, hn::Zero(f)), hn::Le(hn::Abs(hn::Sub(value, center)), limit));
        sum = hn::Add(sum, hn::IfThenElseZero(is_near, value));
        count = hn::Add(count, hn::IfThenElseZero(is_near, one));
      }
    }
    const auto is_measured =
        hn::And(hn::Gt(center, hn::Zero(f)), hn::FirstN(f, HWY_MIN(num - 1 - u, hn::Lanes(f))));
    hn::StoreU(hn::IfThenElseZero(is_measured, hn::Div(sum, hn::Max(count, one))), f, means + u);
  }
}

void NormalsOfRow(const NormalRow& row, const GradientLimits& limits, float* x, float* y,
                  float* z) {
  const Floats f;
  const Ints i32;
  const auto ray_y = hn::Set(f, row.ray_y);
  const auto half_jump = hn::Set(f, 0.5f * limits.max_jump);
  const auto stride = hn::Set(i32, static_cast<int32_t>(row.means_stride));
  for (size_t u = 0; u < row.num; u += hn::Lanes(f)) {
    const auto depth = hn::LoadU(f, row.z + u);
    auto is_known = hn::Gt(depth, hn::Zero(f));
    const auto store = [&](const Vector& nx, const Vector& ny, const Vector& nz) {
      hn::StoreU(hn::IfThenElseZero(is_known, nx), f, x + u);
      hn::StoreU(hn::IfThenElseZero(is_known, ny), f, y + u);
      hn::StoreU(hn::IfThenElseZero(is_known, nz), f, z + u);
    };
    if (hn::AllFalse(f, is_known)) {
      store(hn::Zero(f), hn::Zero(f), hn::Zero(f));
      continue;
    }
    const auto here = hn::Div(hn::Set(f, 1.0f), hn::IfThenElse(is_known, depth, hn::Set(f, 1.0f)));
    const auto reach_px = hn::Min(hn::Max(hn::Mul(hn::Set(f, limits.reach_m * limits.fx), here),
                                          hn::Set(f, limits.min_reach_px)),
                                  hn::Set(f, limits.max_reach_px));
    const auto reach = hn::NearestInt(reach_px);
    const auto at = hn::Mul(hn::Iota(i32, static_cast<int32_t>(u)), hn::Set(i32, row.step));
    const auto down_by = hn::Mul(reach, stride);
    const auto left = hn::GatherIndex(f, row.means, hn::Sub(at, reach));
    const auto right = hn::GatherIndex(f, row.means, hn::Add(at, reach));
    const auto up = hn::GatherIndex(f, row.means, hn::Sub(at, down_by));
    const auto down = hn::GatherIndex(f, row.means, hn::Add(at, down_by));
    // On one smooth surface the middle lies between both sides.
    const auto is_smooth = [&](const Vector& a, const Vector& b) {
      const auto middle = hn::Mul(hn::Set(f, 0.5f), hn::Add(a, b));
      return hn::And(hn::And(hn::Gt(a, hn::Zero(f)), hn::Gt(b, hn::Zero(f))),
                     hn::Lt(hn::Abs(hn::Sub(middle, here)), half_jump));
    };
    is_known = hn::And(is_known, hn::And(is_smooth(left, right), is_smooth(up, down)));
    // n . ray = c / z on a plane, so the gradient of 1 / z is n in pixel coordinates.
    const auto baseline = hn::ConvertTo(f, hn::Add(reach, reach));
    const auto nx = hn::Mul(hn::Div(hn::Sub(right, left), baseline), hn::Set(f, limits.fx));
    const auto ny = hn::Mul(hn::Div(hn::Sub(down, up), baseline), hn::Set(f, limits.fy));
    const auto nz =
        hn::Sub(hn::Sub(here, hn::Mul(nx, hn::LoadU(f, row.ray_x + u))), hn::Mul(ny, ray_y));
    const auto square = hn::Add(hn::Add(hn::Mul(nx, nx), hn::Mul(ny, ny)), hn::Mul(nz, nz));
    is_known = hn::And(is_known, hn::Gt(square, hn::Zero(f)));
    const auto scale = hn::Div(hn::Set(f, -1.0f), hn::Sqrt(square));
    store(hn::Mul(scale, nx), hn::Mul(scale, ny), hn::Mul(scale, nz));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace declutter
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace declutter {
namespace {

HWY_EXPORT(MeanInverseDepths);
HWY_EXPORT(NormalsOfRow);

}  // namespace

void MeanInverseDepths(const float* above, const float* middle, const float* below, size_t num,
                       float max_jump, float* means) {
  HWY_DYNAMIC_DISPATCH(MeanInverseDepths)(above, middle, below, num, max_jump, means);
}

void NormalsOfRow(const NormalRow& row, const GradientLimits& limits, float* x, float* y,
                  float* z) {
  HWY_DYNAMIC_DISPATCH(NormalsOfRow)(row, limits, x, y, z);
}

}  // namespace declutter
#endif
