#include "modules/model_verifier/fit_sums.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "modules/model_verifier/fit_sums.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once for each target
#include <hwy/highway.h>

#include "modules/model_verifier/ray_pixels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace declutter {
namespace HWY_NAMESPACE {

// A sum in sixteen parts: point i counts in part i % 16.
class Sum {
 public:
  // Of the points from i on.
  HWY_INLINE void Add(size_t i, const Vector& values) {
    float* parts = parts_ + i % kRayPadding;
    hn::Store(hn::Add(hn::Load(Floats(), parts), values), Floats(), parts);
  }
  double Total() const {
    double total = 0;
    for (const float part : parts_) total += part;
    return total;
  }

 private:
  HWY_ALIGN float parts_[kRayPadding] = {};
};

HWY_INLINE Vector3 Load(float* const components[3], size_t i) {
  const Floats f;
  return {hn::LoadU(f, components[0] + i), hn::LoadU(f, components[1] + i),
          hn::LoadU(f, components[2] + i)};
}

HWY_INLINE Vector Load(float* const components[3], int axis, size_t i) {
  return hn::LoadU(Floats(), components[axis] + i);
}

// Of the points from i on, those on a surface.
HWY_INLINE Mask IsOn(const FitArrays& points, int32_t surface_bit, size_t i) {
  const Ints i32;
  const auto bits = hn::And(hn::LoadU(i32, points.surfaces + i), hn::Set(i32, surface_bit));
  const auto is_on = hn::RebindMask(Floats(), hn::Ne(bits, hn::Zero(i32)));
  return hn::And(is_on, hn::FirstN(Floats(), HWY_MIN(points.num - i, hn::Lanes(i32))));
}

// Inverse variance of the distance of the points from i on to a surface that rays meet at `cosine`.
HWY_INLINE Vector Weight(const FitArrays& points, const Vector& cosine, size_t i) {
  const auto sigma = hn::Mul(hn::LoadU(Floats(), points.sigma + i), cosine);
  return hn::Div(Constant(1.0f), hn::Mul(sigma, sigma));
}

// Half the noise of a sensor does not average out at grazing rays, which bounds the weight of a
// plane that is seen under them.
HWY_INLINE Vector WeightOnPlane(const FitArrays& points, const Vector& cosine, size_t i) {
  return Weight(points, hn::Max(hn::Abs(cosine), Constant(0.5f)), i);
}

// Of the points from i on that are on a face, those for which another one is nearer.
HWY_INLINE Mask IsNearerTo(int other_axis, const FitArrays& points, const FaceRegion& region,
                           const Vector& distance, size_t i) {
  const auto p = Load(points.p, other_axis, i);
  const auto other = hn::Abs(hn::Sub(hn::Abs(p), Constant(region.half_size[other_axis])));
  const int32_t bits = SurfaceBit(other_axis, 1) | SurfaceBit(other_axis, -1);
  return hn::And(IsOn(points, bits, i), hn::Lt(other, distance));
}

FaceSums SumFace(const FitArrays& points, const FaceRegion& region) {
  const Floats f;
  const int axis = region.axis;
  const int a = axis == 0 ? 1 : 0, b = axis == 2 ? 1 : 2;
  const float place = static_cast<float>(region.sign) * region.half_size[axis];
  const auto is_within = [&](int k, size_t i) {
    return hn::Le(hn::Abs(Load(points.p, k, i)),
                  Constant(region.half_size[k] - region.edge_margin));
  };
  FaceSums sums;
  Sum w, wx, wl, wll, wlx;
  for (size_t i = 0; i < points.num; i += hn::Lanes(f)) {
    auto is_on = hn::And(IsOn(points, SurfaceBit(axis, region.sign), i),
                         hn::And(is_within(a, i), is_within(b, i)));
    if (hn::AllFalse(f, is_on)) continue;
    const auto from_face = hn::Sub(Load(points.p, axis, i), Constant(place));
    const auto distance = hn::Abs(from_face);
    is_on = hn::AndNot(hn::Or(IsNearerTo(a, points, region, distance, i),
                              IsNearerTo(b, points, region, distance, i)),
                       is_on);
    sums.num += Count(is_on);
    const auto weight =
        hn::IfThenElseZero(is_on, WeightOnPlane(points, Load(points.ray, axis, i), i));
    const auto x = hn::IfThenElseZero(is_on, from_face);
    w.Add(i, weight);
    wx.Add(i, hn::Mul(weight, x));
    if (axis == 2) continue;
    // A yaw of the solid by delta takes the plane x = place to x + delta * y = place.
    const auto lever =
        hn::IfThenElseZero(is_on, axis == 0 ? Load(points.p, 1, i) : hn::Neg(Load(points.p, 0, i)));
    const auto weighted = hn::Mul(weight, lever);
    wl.Add(i, weighted);
    wll.Add(i, hn::Mul(weighted, lever));
    wlx.Add(i, hn::Mul(weighted, x));
  }
  sums.w = w.Total();
  sums.wx = wx.Total();
  sums.wl = wl.Total();
  sums.wll = wll.Total();
  sums.wlx = wlx.Total();
  return sums;
}

SideSums SumSide(const FitArrays& points, const SideRegion& region) {
  const Floats f;
  const auto radius = Constant(region.radius);
  SideSums sums;
  Sum w, wnx, wny, wnxnx, wnxny, wnyny, wr, wnxr, wnyr;
  for (size_t i = 0; i < points.num; i += hn::Lanes(f)) {
    auto is_on = IsOn(points, kCylinderSideBit, i);
    // Seen along the axis: the ray's direction, and the point along and across it. Normal and
    // weight are those of the place where the ray meets the side, which noise does not move: with
    // those of the point, what is measured too far back would seem more oblique, count more, and
    // make the radius smaller.
    const Vector3 ray = Load(points.ray, i);
    const auto ray_sine = hn::Sqrt(hn::Add(hn::Mul(ray.x, ray.x), hn::Mul(ray.y, ray.y)));
    const auto ux = hn::Div(ray.x, ray_sine), uy = hn::Div(ray.y, ray_sine);
    const auto x = hn::Sub(Load(points.p, 0, i), Constant(region.x));
    const auto y = hn::Sub(Load(points.p, 1, i), Constant(region.y));
    const auto along_ray = hn::Add(hn::Mul(x, ux), hn::Mul(y, uy));
    const auto across = hn::Div(hn::Sub(hn::Mul(y, ux), hn::Mul(x, uy)), radius);
    const auto cosine_across =
        hn::Sqrt(hn::Max(hn::Sub(Constant(1.0f), hn::Mul(across, across)), hn::Zero(f)));
    const auto cosine = hn::Mul(cosine_across, ray_sine);
    is_on = hn::And(is_on, hn::Ge(cosine, Constant(region.min_incidence_cos)));
    if (hn::AllFalse(f, is_on)) continue;
    const auto residual =
        hn::Neg(hn::Mul(cosine_across, hn::Add(along_ray, hn::Mul(radius, cosine_across))));
    const auto tolerance =
        hn::Max(Constant(region.min_tolerance_m),
                hn::Mul(Constant(region.tolerance_in_sigmas), hn::LoadU(f, points.sigma + i)));
    const auto limit = hn::Mul(tolerance, hn::Max(cosine, Constant(0.5f)));
    const auto is_in_front = hn::Le(along_ray, hn::Zero(f));
    is_on = hn::And(is_on, hn::And(is_in_front, hn::Le(hn::Abs(residual), limit)));
    if (hn::AllFalse(f, is_on)) continue;
    const auto nx = hn::IfThenElseZero(
        is_on, hn::Sub(hn::Neg(hn::Mul(cosine_across, ux)), hn::Mul(across, uy)));
    const auto ny =
        hn::IfThenElseZero(is_on, hn::Sub(hn::Mul(across, ux), hn::Mul(cosine_across, uy)));
    const Vector3 n = Load(points.n, i);
    const auto is_turned_away = hn::And(
        IsKnown(n),
        hn::Lt(hn::Add(hn::Mul(nx, n.x), hn::Mul(ny, n.y)), Constant(region.min_normal_cos)));
    is_on = hn::AndNot(is_turned_away, is_on);
    sums.num += Count(is_on);
    const auto weight = hn::IfThenElseZero(is_on, Weight(points, cosine, i));
    const auto r = hn::IfThenElseZero(is_on, residual);
    const auto weighted_nx = hn::Mul(weight, nx), weighted_ny = hn::Mul(weight, ny);
    w.Add(i, weight);
    wnx.Add(i, weighted_nx);
    wny.Add(i, weighted_ny);
    wnxnx.Add(i, hn::Mul(weighted_nx, nx));
    wnxny.Add(i, hn::Mul(weighted_nx, ny));
    wnyny.Add(i, hn::Mul(weighted_ny, ny));
    wr.Add(i, hn::Mul(weight, r));
    wnxr.Add(i, hn::Mul(weighted_nx, r));
    wnyr.Add(i, hn::Mul(weighted_ny, r));
  }
  sums.w = w.Total();
  sums.nx = wnx.Total();
  sums.ny = wny.Total();
  sums.nxnx = wnxnx.Total();
  sums.nxny = wnxny.Total();
  sums.nyny = wnyny.Total();
  sums.r = wr.Total();
  sums.nxr = wnxr.Total();
  sums.nyr = wnyr.Total();
  return sums;
}

DiscSums SumDisc(const FitArrays& points, const DiscRegion& region) {
  const Floats f;
  DiscSums sums;
  Sum w, wz;
  for (size_t i = 0; i < points.num; i += hn::Lanes(f)) {
    const auto x = hn::Sub(Load(points.p, 0, i), Constant(region.x));
    const auto y = hn::Sub(Load(points.p, 1, i), Constant(region.y));
    const auto is_on =
        hn::And(IsOn(points, SurfaceBit(2, 1), i),
                hn::Le(hn::Sqrt(hn::Add(hn::Mul(x, x), hn::Mul(y, y))), Constant(region.radius)));
    if (hn::AllFalse(f, is_on)) continue;
    sums.num += Count(is_on);
    const auto weight = hn::IfThenElseZero(is_on, WeightOnPlane(points, Load(points.ray, 2, i), i));
    w.Add(i, weight);
    const auto z =
        hn::IfThenElseZero(is_on, hn::Sub(Load(points.p, 2, i), Constant(region.height)));
    wz.Add(i, hn::Mul(weight, z));
  }
  sums.w = w.Total();
  sums.wz = wz.Total();
  return sums;
}

}  // namespace HWY_NAMESPACE
}  // namespace declutter
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace declutter {
namespace {

HWY_EXPORT(SumFace);
HWY_EXPORT(SumSide);
HWY_EXPORT(SumDisc);

}  // namespace

FaceSums SumFace(const FitArrays& points, const FaceRegion& region) {
  return HWY_DYNAMIC_DISPATCH(SumFace)(points, region);
}

SideSums SumSide(const FitArrays& points, const SideRegion& region) {
  return HWY_DYNAMIC_DISPATCH(SumSide)(points, region);
}

DiscSums SumDisc(const FitArrays& points, const DiscRegion& region) {
  return HWY_DYNAMIC_DISPATCH(SumDisc)(points, region);
}

}  // namespace declutter
#endif
