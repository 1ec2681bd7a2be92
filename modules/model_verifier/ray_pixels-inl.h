// What kernels over the pixels of a window have in common, for each target of Highway.
#if defined(DECLUTTER_RAY_PIXELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef DECLUTTER_RAY_PIXELS_INL_H_
#undef DECLUTTER_RAY_PIXELS_INL_H_
#else
#define DECLUTTER_RAY_PIXELS_INL_H_
#endif

#include <hwy/highway.h>

#include "modules/geometry/packing-inl.h"
#include "modules/model_verifier/ray_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace declutter {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, kRayPadding>;
using Ints = hn::RebindToSigned<Floats>;
using Vector = hn::Vec<Floats>;
using Mask = hn::Mask<Floats>;

struct Vector3 {
  Vector x, y, z;
};

HWY_INLINE Vector Constant(float value) { return hn::Set(Floats(), value); }

HWY_INLINE Vector Max0(const Vector& v) { return hn::Max(v, hn::Zero(Floats())); }

HWY_INLINE Vector Dot(const float* a, const Vector3& b) {
  return hn::Add(hn::Add(hn::Mul(Constant(a[0]), b.x), hn::Mul(Constant(a[1]), b.y)),
                 hn::Mul(Constant(a[2]), b.z));
}

HWY_INLINE Vector3 Rotate(const float* R, const Vector3& v) {
  return {Dot(R, v), Dot(R + 3, v), Dot(R + 6, v)};
}

// The rays of a row of pixels in O: along_x * x of the ray in C + rest.
struct RowRays {
  float rest[3];

  HWY_INLINE RowRays(const float* R_OC, float ray_y) {
    for (int i = 0; i < 3; ++i) rest[i] = R_OC[3 * i + 1] * ray_y + R_OC[3 * i + 2];
  }
  HWY_INLINE Vector3 At(const float* R_OC, const Vector& ray_x) const {
    const auto along = [&](int i) {
      return hn::Add(hn::Mul(Constant(R_OC[3 * i]), ray_x), Constant(rest[i]));
    };
    return {along(0), along(1), along(2)};
  }
};

// Some pixels of a row.
struct Pixels {
  Vector3 ray_C;
  Vector z;
  Mask is_seen;      // in the window
  Mask is_measured;  // and with depth
};

HWY_INLINE Pixels PixelsAt(const RayWindow& window, int u, int v) {
  const Floats f;
  Pixels pixels;
  pixels.ray_C = {hn::LoadU(f, window.ray_x + u), Constant(window.ray_y[v]), Constant(1.0f)};
  pixels.is_seen = hn::FirstN(f, HWY_MIN(static_cast<size_t>(window.u_end - u), hn::Lanes(f)));
  pixels.z = hn::IfThenElseZero(
      pixels.is_seen, hn::LoadU(f, window.z + static_cast<size_t>(v) * window.stride + u));
  pixels.is_measured = hn::Gt(pixels.z, hn::Zero(f));
  return pixels;
}

HWY_INLINE Vector3 NormalsAt(const RayWindow& window, int u, int v) {
  const Floats f;
  const size_t i = static_cast<size_t>(v >> window.normal_shift) * window.normal_stride +
                   static_cast<size_t>(u >> window.normal_shift);
  const Vector3 n = {hn::LoadU(f, window.normal_x + i), hn::LoadU(f, window.normal_y + i),
                     hn::LoadU(f, window.normal_z + i)};
  if (window.normal_shift == 0) return n;
  // Every normal is that of two pixels.
  const auto of_pixels = hn::IndicesFromVec(f, hn::ShiftRight<1>(hn::Iota(Ints(), u & 1)));
  return {hn::TableLookupLanes(n.x, of_pixels), hn::TableLookupLanes(n.y, of_pixels),
          hn::TableLookupLanes(n.z, of_pixels)};
}

HWY_INLINE Vector Tolerance(const RayLimits& limits, const Vector& z) {
  return hn::Max(Constant(limits.min_tolerance_m),
                 hn::Mul(Constant(limits.tolerance_per_square), hn::Mul(z, z)));
}

HWY_INLINE Vector LeastHeight(const RayLimits& limits, const Vector& z) {
  return hn::Mul(Constant(limits.min_height_in_tolerances), Tolerance(limits, z));
}

HWY_INLINE Vector HeightAbove(const float* support, const Pixels& pixels) {
  return hn::Add(Constant(support[3]), hn::Mul(pixels.z, Dot(support, pixels.ray_C)));
}

HWY_INLINE Vector3 PointInO(const RaySolid& solid, const Vector3& ray_O, const Vector& z) {
  const float* o = solid.camera_O;
  return {hn::Add(Constant(o[0]), hn::Mul(z, ray_O.x)),
          hn::Add(Constant(o[1]), hn::Mul(z, ray_O.y)),
          hn::Add(Constant(o[2]), hn::Mul(z, ray_O.z))};
}

HWY_INLINE int Count(const Mask& mask) { return static_cast<int>(hn::CountTrue(Floats(), mask)); }

HWY_INLINE Mask IsKnown(const Vector3& n) {
  return hn::Or(hn::Ne(n.x, hn::Zero(Floats())),
                hn::Or(hn::Ne(n.y, hn::Zero(Floats())), hn::Ne(n.z, hn::Zero(Floats()))));
}

}  // namespace HWY_NAMESPACE
}  // namespace declutter
HWY_AFTER_NAMESPACE();

#endif
