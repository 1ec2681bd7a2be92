#include "modules/model_verifier/fit_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "modules/model_verifier/fit_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once for each target
#include <hwy/highway.h>

#include "modules/model_verifier/ray_pixels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace declutter {
namespace HWY_NAMESPACE {

// Measurements near a solid, in O.
struct NearPoints {
  Vector3 p, n, ray;
  Vector sigma;
  Mask has_normal;
};

// Bits of the points that lie on one face.
HWY_INLINE hn::Vec<Ints> BitsOfFace(const NearPoints& points, const RaySolid& solid,
                                    const FitLimits& limits, const Vector& tolerance, int axis,
                                    int sign) {
  const Ints i32;
  const auto along = [&](const Vector3& v) {
    return hn::Mul(Constant(static_cast<float>(sign)), axis == 0 ? v.x : axis == 1 ? v.y : v.z);
  };
  const auto distance = hn::Abs(hn::Sub(along(points.p), Constant(solid.half_size[axis])));
  const auto is_turned_away =
      hn::And(points.has_normal, hn::Le(along(points.n), Constant(limits.min_normal_cos)));
  const auto is_on = hn::AndNot(
      is_turned_away, hn::And(hn::Le(distance, tolerance),
                              hn::Le(along(points.ray), Constant(-limits.min_incidence_cos))));
  return hn::IfThenElseZero(hn::RebindMask(i32, is_on), hn::Set(i32, SurfaceBit(axis, sign)));
}

HWY_INLINE hn::Vec<Ints> BitsOf(const NearPoints& points, const RaySolid& solid,
                                const FitLimits& limits) {
  const Ints i32;
  const auto tolerance = hn::Max(Constant(limits.min_tolerance_m),
                                 hn::Mul(Constant(limits.tolerance_in_sigmas), points.sigma));
  auto bits = BitsOfFace(points, solid, limits, tolerance, 2, 1);
  if (solid.is_cylinder) {
    const auto is_between =
        hn::Le(hn::Abs(points.p.z), Constant(solid.half_size[2] - limits.end_margin_m));
    return hn::Or(
        bits, hn::IfThenElseZero(hn::RebindMask(i32, is_between), hn::Set(i32, kCylinderSideBit)));
  }
  for (int axis = 0; axis < 2; ++axis) {
    bits = hn::Or(bits, hn::Or(BitsOfFace(points, solid, limits, tolerance, axis, 1),
                               BitsOfFace(points, solid, limits, tolerance, axis, -1)));
  }
  return bits;
}

// Appends the points that have bits.
HWY_INLINE void AppendPoints(const NearPoints& points, const hn::Vec<Ints>& bits,
                             FitArrays* arrays) {
  const Floats f;
  const Ints i32;
  const auto is_on = hn::Ne(bits, hn::Zero(i32));
  const Packing<Floats> pack(f, hn::RebindMask(f, is_on));
  const auto append = [&](const Vector& values, float* array) {
    hn::StoreU(pack(values), f, array + arrays->num);
  };
  const Vector3* const vectors[] = {&points.p, &points.n, &points.ray};
  float* const* const to[] = {arrays->p, arrays->n, arrays->ray};
  for (int k = 0; k < 3; ++k) {
    append(vectors[k]->x, to[k][0]);
    append(vectors[k]->y, to[k][1]);
    append(vectors[k]->z, to[k][2]);
  }
  append(points.sigma, arrays->sigma);
  hn::StoreU(pack(bits), i32, arrays->surfaces + arrays->num);
  arrays->num += hn::CountTrue(i32, is_on);
}

HWY_INLINE void FindInPixels(const RaySolid& solid, const RayWindow& window,
                             const FitLimits& limits, int u, int v, FitArrays* arrays) {
  const Floats f;
  const Pixels pixels = PixelsAt(window, u, v);
  if (hn::AllFalse(f, pixels.is_measured)) return;
  const Vector3 ray_O = Rotate(solid.R_OC, pixels.ray_C);
  NearPoints points;
  points.p = PointInO(solid, ray_O, pixels.z);
  auto is_near = pixels.is_measured;
  const Vector* const p[] = {&points.p.x, &points.p.y, &points.p.z};
  for (int axis = 0; axis < 3; ++axis) {
    is_near = hn::And(is_near,
                      hn::Le(hn::Abs(*p[axis]), Constant(solid.half_size[axis] + limits.margin_m)));
  }
  if (hn::AllFalse(f, is_near)) return;
  const auto square = hn::Mul(pixels.z, pixels.z);
  const Vector3& r = pixels.ray_C;
  const auto length =
      hn::Sqrt(hn::Add(hn::Add(hn::Mul(r.x, r.x), hn::Mul(r.y, r.y)), Constant(1.0f)));
  points.sigma = hn::Mul(hn::Mul(Constant(limits.sigma_per_square), square), length);
  points.ray = {hn::Div(ray_O.x, length), hn::Div(ray_O.y, length), hn::Div(ray_O.z, length)};
  const Vector3 n_C = NormalsAt(window, u, v);
  points.has_normal = IsKnown(n_C);
  points.n = Rotate(solid.R_OC, n_C);
  const auto bits = BitsOf(points, solid, limits);
  AppendPoints(points, hn::IfThenElseZero(hn::RebindMask(Ints(), is_near), bits), arrays);
}

// Takes copies: what is behind a reference would be loaded anew after each store of a vector.
HWY_INLINE size_t FindIn(const RaySolid solid, const RayWindow window, const FitLimits limits,
                         FitArrays points) {
  points.num = 0;
  for (int v = window.v_begin; v < window.v_end; ++v) {
    for (int u = window.u_begin; u < window.u_end; u += static_cast<int>(hn::Lanes(Floats()))) {
      FindInPixels(solid, window, limits, u, v, &points);
    }
  }
  return points.num;
}

void FindFitPoints(const RaySolid& solid, const RayWindow& window, const FitLimits& limits,
                   FitArrays* points) {
  points->num = FindIn(solid, window, limits, *points);
}

}  // namespace HWY_NAMESPACE
}  // namespace declutter
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace declutter {
namespace {

HWY_EXPORT(FindFitPoints);

}  // namespace

void FindFitPoints(const RaySolid& solid, const RayWindow& window, const FitLimits& limits,
                   FitArrays* points) {
  HWY_DYNAMIC_DISPATCH(FindFitPoints)(solid, window, limits, points);
}

}  // namespace declutter
#endif
