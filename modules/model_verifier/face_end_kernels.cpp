#include "modules/model_verifier/face_end_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "modules/model_verifier/face_end_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once for each target
#include <hwy/highway.h>

#include "modules/model_verifier/ray_pixels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace declutter {
namespace HWY_NAMESPACE {

// Behind the bins of all that are there, gone and unknown.
constexpr int32_t kNotCounted = 3 * EndProfile::kNumBins;

// Where rays meet the plane of a face.
struct FaceHit {
  Vector outward;      // [m] from the end
  Vector outward_ray;  // by how much that grows with 1 m of depth
  Vector length;       // [m] of a ray with 1 m of depth
  Vector z;            // [m] depth there
  Mask is_near;        // in the profile
};

HWY_INLINE FaceHit HitOf(const RaySolid& box, const FaceLimits& limits, const FaceEnd& end,
                         const Vector3& ray_C, const Vector3& ray_O) {
  const auto along = [&](int axis) { return axis == 0 ? ray_O.x : axis == 1 ? ray_O.y : ray_O.z; };
  const int across = 3 - end.face_axis - end.end_axis;
  const float face_sign = static_cast<float>(end.face_sign);
  const float plane = face_sign * box.half_size[end.face_axis];
  FaceHit hit;
  const auto toward = hn::Mul(Constant(-face_sign), along(end.face_axis));
  hit.length = hn::Sqrt(
      hn::Add(hn::Add(hn::Mul(ray_C.x, ray_C.x), hn::Mul(ray_C.y, ray_C.y)), Constant(1.0f)));
  const auto is_seen = hn::Ge(toward, hn::Mul(Constant(limits.min_incidence_cos), hit.length));
  const auto ray = hn::IfThenElse(is_seen, along(end.face_axis), Constant(1.0f));
  hit.z = hn::Div(Constant(plane - box.camera_O[end.face_axis]), ray);
  const auto at = [&](int axis) {
    return hn::Add(Constant(box.camera_O[axis]), hn::Mul(hit.z, along(axis)));
  };
  const auto end_sign = Constant(static_cast<float>(end.end_sign));
  hit.outward = hn::Sub(hn::Mul(end_sign, at(end.end_axis)), Constant(box.half_size[end.end_axis]));
  hit.outward_ray = hn::Mul(end_sign, along(end.end_axis));
  const auto is_inside =
      hn::Le(hn::Abs(at(across)), Constant(box.half_size[across] - limits.edge_margin_m));
  const float last = limits.first_bin_m + limits.bin_m * EndProfile::kNumBins;
  hit.is_near = hn::And(hn::And(is_seen, is_inside),
                        hn::And(hn::Ge(hit.outward, Constant(limits.first_bin_m)),
                                hn::Lt(hit.outward, Constant(last))));
  return hit;
}

HWY_INLINE void AddPixels(const RaySolid& box, const RayWindow& window, const FaceLimits& limits,
                          const FaceEnd& end, const RowRays& rays, int u, int v, int32_t* counts) {
  const Floats f;
  const Ints i32;
  const Vector3 ray_C = {hn::LoadU(f, window.ray_x + u), Constant(window.ray_y[v]), Constant(1.0f)};
  const FaceHit hit = HitOf(box, limits, end, ray_C, rays.At(box.R_OC, ray_C.x));
  const auto is_near = hn::And(
      hit.is_near, hn::FirstN(f, HWY_MIN(static_cast<size_t>(window.u_end - u), hn::Lanes(f))));
  if (hn::AllFalse(f, is_near)) return;
  const auto signed_z = hn::LoadU(f, window.z + static_cast<size_t>(v) * window.stride + u);
  const auto z = hn::Abs(signed_z);
  const auto tolerance = hn::Max(Constant(limits.min_tolerance_m),
                                 hn::Mul(Constant(limits.tolerance_per_square), hn::Mul(z, z)));
  const auto behind = hn::Mul(hn::Sub(z, hit.z), hit.length);
  const Vector3 n_C = NormalsAt(window, u, v);
  const auto cosine =
      hn::Mul(Constant(static_cast<float>(end.face_sign)), Dot(box.R_OC + 3 * end.face_axis, n_C));
  const auto is_turned = hn::And(IsKnown(n_C), hn::Lt(cosine, Constant(limits.min_normal_cos)));
  const auto is_other = hn::Lt(signed_z, hn::Zero(f));
  const auto is_behind = hn::Gt(behind, hn::Add(tolerance, tolerance));
  const auto is_gone = hn::Or(is_behind, is_other);
  // A face that bends, or an edge that the sensor blurs, is not free space.
  const auto is_unsure = hn::AndNot(is_gone, hn::Or(is_turned, hn::Gt(behind, tolerance)));
  const auto is_unknown = hn::Eq(z, hn::Zero(f));
  const auto is_counted = hn::AndNot(
      is_unsure, hn::And(is_near, hn::Or(is_unknown, hn::Ge(behind, hn::Neg(tolerance)))));
  // What touches the face rises from where it is measured; what is behind is seen past the face.
  const auto outward =
      hn::Add(hit.outward, hn::IfThenElseZero(hn::AndNot(hn::Or(is_behind, is_unknown), is_other),
                                              hn::Mul(hn::Sub(z, hit.z), hit.outward_ray)));
  const auto row =
      hn::IfThenElse(hn::RebindMask(i32, is_unknown), hn::Set(i32, 2),
                     hn::IfThenElseZero(hn::RebindMask(i32, is_gone), hn::Set(i32, 1)));
  const auto bin = hn::ConvertTo(
      i32, hn::Mul(hn::Sub(outward, Constant(limits.first_bin_m)), Constant(1 / limits.bin_m)));
  const auto index =
      hn::Add(hn::Mul(row, hn::Set(i32, EndProfile::kNumBins)),
              hn::Min(hn::Max(bin, hn::Zero(i32)), hn::Set(i32, EndProfile::kNumBins - 1)));
  HWY_ALIGN int32_t indices[kRayPadding];
  hn::Store(hn::IfThenElse(hn::RebindMask(i32, is_counted), index, hn::Set(i32, kNotCounted)), i32,
            indices);
  for (size_t i = 0; i < hn::Lanes(i32); ++i) ++counts[indices[i]];
}

void AddToProfile(const RaySolid& box, const RayWindow& window, const FaceLimits& limits,
                  const FaceEnd& end, EndProfile* profile) {
  int32_t counts[kNotCounted + 1] = {};
  for (int v = window.v_begin; v < window.v_end; ++v) {
    const RowRays rays(box.R_OC, window.ray_y[v]);
    for (int u = window.u_begin; u < window.u_end; u += static_cast<int>(hn::Lanes(Floats()))) {
      AddPixels(box, window, limits, end, rays, u, v, counts);
    }
  }
  for (int i = 0; i < EndProfile::kNumBins; ++i) {
    profile->there[i] += counts[i];
    profile->gone[i] += counts[EndProfile::kNumBins + i];
    profile->unknown[i] += counts[2 * EndProfile::kNumBins + i];
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace declutter
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace declutter {
namespace {

HWY_EXPORT(AddToProfile);

}  // namespace

void AddToProfile(const RaySolid& box, const RayWindow& window, const FaceLimits& limits,
                  const FaceEnd& end, EndProfile* profile) {
  HWY_DYNAMIC_DISPATCH(AddToProfile)(box, window, limits, end, profile);
}

}  // namespace declutter
#endif
