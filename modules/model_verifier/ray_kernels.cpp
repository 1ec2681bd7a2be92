#include "modules/model_verifier/ray_kernels.h"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "modules/model_verifier/ray_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles the rest of this file once for each target
#include <hwy/highway.h>

#include "modules/model_verifier/ray_pixels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace declutter {
namespace HWY_NAMESPACE {

// Where rays are inside a solid, as depths.
struct Passage {
  Vector z_in, z_out;
  Mask through_top;   // enters through the face at the upper end of O's z axis
  Mask through_ends;  // enters through one end of O's z axis and leaves through the other

  HWY_INLINE Mask is_hit() const {
    return hn::And(hn::Lt(z_in, z_out), hn::Gt(z_in, hn::Zero(Floats())));
  }
};

// Cuts a passage to the part between the two planes across an axis.
HWY_INLINE void CutBySlab(float half, float camera, const Vector& ray, Passage* passage) {
  // Almost parallel to the planes, the ray is between them for ever or never.
  const auto tiny = Constant(1e-9f);
  const auto d = hn::IfThenElse(hn::Lt(hn::Abs(ray), tiny), tiny, ray);
  const auto inverse = hn::Div(Constant(1.0f), d);
  const auto middle = hn::Mul(Constant(-camera), inverse);
  const auto reach = hn::Abs(hn::Mul(Constant(half), inverse));
  passage->z_in = hn::Max(passage->z_in, hn::Sub(middle, reach));
  passage->z_out = hn::Min(passage->z_out, hn::Add(middle, reach));
}

template <bool kIsCylinder>
HWY_INLINE Passage PassageOf(const RaySolid& solid, const Vector3& ray_O) {
  const Floats f;
  const auto none = hn::FirstN(f, 0);
  Passage passage{hn::Zero(f), Constant(std::numeric_limits<float>::max()), none, none};
  CutBySlab(solid.half_size[2], solid.camera_O[2], ray_O.z, &passage);
  const Vector z_first = passage.z_in, z_last = passage.z_out;
  const auto mark_ends = [&] {
    passage.through_ends = hn::And(hn::Eq(passage.z_in, z_first), hn::Eq(passage.z_out, z_last));
  };
  if (!kIsCylinder) {
    CutBySlab(solid.half_size[1], solid.camera_O[1], ray_O.y, &passage);
    CutBySlab(solid.half_size[0], solid.camera_O[0], ray_O.x, &passage);
    mark_ends();
    return passage;
  }
  const float* o = solid.camera_O;
  const float r = solid.half_size[0];
  const auto a =
      hn::Max(hn::Add(hn::Mul(ray_O.x, ray_O.x), hn::Mul(ray_O.y, ray_O.y)), Constant(1e-12f));
  const auto b = hn::Add(hn::Mul(Constant(o[0]), ray_O.x), hn::Mul(Constant(o[1]), ray_O.y));
  const auto c = Constant(o[0] * o[0] + o[1] * o[1] - r * r);
  const auto discriminant = hn::Sub(hn::Mul(b, b), hn::Mul(a, c));
  const auto root = hn::Sqrt(Max0(discriminant));
  const auto inverse = hn::Div(Constant(1.0f), a);
  const auto side_in = hn::Mul(hn::Neg(hn::Add(b, root)), inverse);
  const auto side_out = hn::Mul(hn::Sub(root, b), inverse);
  passage.through_top = hn::And(hn::Ge(passage.z_in, side_in), hn::Lt(ray_O.z, hn::Zero(f)));
  passage.z_in = hn::Max(passage.z_in, side_in);
  passage.z_out =
      hn::IfThenElseZero(hn::Gt(discriminant, hn::Zero(f)), hn::Min(passage.z_out, side_out));
  mark_ends();
  return passage;
}

// Signed distances of points to the faces across each axis; those of a cylinder to its side and its
// ends are x and z.
struct FaceDistances {
  Vector x, y, z;
  Vector radial;  // [m] from the axis of a cylinder
};

template <bool kIsCylinder>
HWY_INLINE FaceDistances DistancesToFaces(const RaySolid& solid, const Vector3& p) {
  const auto to_face = [&](const Vector& q, int axis) {
    return hn::Sub(hn::Abs(q), Constant(solid.half_size[axis]));
  };
  if (kIsCylinder) {
    const auto radial = hn::Sqrt(hn::Add(hn::Mul(p.x, p.x), hn::Mul(p.y, p.y)));
    const auto side = hn::Sub(radial, Constant(solid.half_size[0]));
    return {side, side, to_face(p.z, 2), radial};
  }
  return {to_face(p.x, 0), to_face(p.y, 1), to_face(p.z, 2), p.x};
}

// [m] to the surface, negative inside.
template <bool kIsCylinder>
HWY_INLINE Vector SignedDistance(const FaceDistances& q) {
  const auto x = Max0(q.x), y = Max0(q.y), z = Max0(q.z);
  auto square = hn::Add(hn::Mul(x, x), hn::Mul(z, z));
  auto largest = hn::Max(q.x, q.z);
  if (!kIsCylinder) {
    square = hn::Add(square, hn::Mul(y, y));
    largest = hn::Max(largest, q.y);
  }
  return hn::Add(hn::Sqrt(square), hn::Min(largest, hn::Zero(Floats())));
}

// Cosine of a normal in O and that of the face that a point is on; `is_certain` where the point is
// not near an edge.
struct NormalMatch {
  Vector cosine;
  Mask is_certain;
};

// On which side of an axis the face is that a point lies on: on that of the camera if it may, as
// the other cannot be seen, and a solid may be thinner than its tolerance.
HWY_INLINE Vector SideOf(const RaySolid& solid, int axis, const Vector& position,
                         const Vector& tolerance) {
  const auto seen = Constant(solid.camera_O[axis] < 0 ? -1.0f : 1.0f);
  const auto may_be_seen =
      hn::Gt(hn::Mul(position, seen), hn::Sub(Constant(solid.half_size[axis]), tolerance));
  return hn::IfThenElse(may_be_seen, seen, hn::CopySign(Constant(1.0f), position));
}

template <bool kIsCylinder>
HWY_INLINE NormalMatch MatchNormal(const RaySolid& solid, const FaceDistances& q, const Vector3& p,
                                   const Vector3& n, const Vector& tolerance, float edge_margin) {
  const auto inside = Constant(-edge_margin);
  const auto on_end = SideOf(solid, 2, p.z, tolerance);
  if (kIsCylinder) {
    const auto radial = hn::Max(q.radial, Constant(1e-9f));
    const auto side = hn::Div(hn::Add(hn::Mul(p.x, n.x), hn::Mul(p.y, n.y)), radial);
    const auto end = hn::Mul(on_end, n.z);
    return {hn::IfThenElse(hn::Gt(q.x, q.z), side, end), hn::Le(hn::Min(q.x, q.z), inside)};
  }
  const auto is_x = hn::And(hn::Ge(q.x, q.y), hn::Ge(q.x, q.z));
  const auto is_y = hn::AndNot(is_x, hn::Ge(q.y, q.z));
  const auto x = hn::Mul(SideOf(solid, 0, p.x, tolerance), n.x);
  const auto y = hn::Mul(SideOf(solid, 1, p.y, tolerance), n.y);
  const auto z = hn::Mul(on_end, n.z);
  const auto second = hn::IfThenElse(is_x, hn::Max(q.y, q.z),
                                     hn::IfThenElse(is_y, hn::Max(q.x, q.z), hn::Max(q.x, q.y)));
  return {hn::IfThenElse(is_x, x, hn::IfThenElse(is_y, y, z)), hn::Le(second, inside)};
}

// Points beside the solid that lie in the plane of its top face, of those at its height. The side
// of something that stands in front is no part of it.
template <bool kIsCylinder>
HWY_INLINE void AppendOverhanging(const RaySolid& solid, const RayWindow& window,
                                  const RayLimits& limits, const Pixels& pixels,
                                  const Mask& is_at_top, const Vector3& ray_O, int u, int v,
                                  RayCounts* counts) {
  const Floats f;
  const FaceDistances q = DistancesToFaces<kIsCylinder>(solid, PointInO(solid, ray_O, pixels.z));
  const auto overhang = kIsCylinder ? q.x : hn::Max(q.x, q.y);
  auto is_overhanging = hn::And(
      is_at_top,
      hn::And(hn::Ge(overhang, hn::Zero(f)), hn::Le(overhang, Constant(limits.max_overhang_m))));
  if (hn::AllFalse(f, is_overhanging)) return;
  is_overhanging = hn::And(is_overhanging,
                           hn::Ge(HeightAbove(solid.support, pixels), Tolerance(limits, pixels.z)));
  const Vector3 n_C = NormalsAt(window, u, v);
  const auto is_top = hn::Gt(Dot(solid.R_OC + 6, n_C), Constant(limits.min_normal_cos));
  is_overhanging = hn::And(is_overhanging, hn::Or(is_top, hn::Not(IsKnown(n_C))));
  const Ints i32;
  const auto index = hn::Iota(i32, v * window.columns + u);
  hn::StoreU(Packing<Floats>(f, is_overhanging)(index), i32,
             counts->overhanging + counts->num_overhanging);
  counts->num_overhanging += Count(is_overhanging);
}

// Appends the pixels on the surface whose normals do not contradict it.
template <bool kIsCylinder>
HWY_INLINE void Explain(const RaySolid& solid, const RayWindow& window, const RayLimits& limits,
                        const Mask& is_on, const Vector3& p, const FaceDistances& q,
                        const Vector& distance, const Vector& tolerance, int u, int v,
                        RayCounts* counts) {
  const Floats f;
  const Ints i32;
  const auto one = Constant(1.0f);
  const Vector3 n_C = NormalsAt(window, u, v);
  const NormalMatch match = MatchNormal<kIsCylinder>(solid, q, p, Rotate(solid.R_OC, n_C),
                                                     tolerance, limits.edge_margin_m);
  const auto relative = hn::Div(distance, tolerance);
  const auto fit_of_normal = hn::Mul(hn::Sub(match.cosine, Constant(limits.min_normal_cos)),
                                     Constant(1 / (1 - limits.min_normal_cos)));
  const auto normal_fit =
      hn::IfThenElse(hn::And(match.is_certain, IsKnown(n_C)), fit_of_normal, one);
  const auto is_contradicting = hn::And(is_on, hn::Lt(normal_fit, hn::Zero(f)));
  counts->num_contradicting += Count(is_contradicting);
  const auto is_explained = hn::AndNot(is_contradicting, is_on);
  const auto fit = hn::IfThenElseZero(
      is_explained, hn::Mul(hn::Min(normal_fit, one), hn::Sub(one, hn::Mul(relative, relative))));
  const auto fixed = hn::NearestInt(hn::Mul(fit, Constant(static_cast<float>(kFitUnit))));
  counts->fit += hn::GetLane(hn::SumOfLanes(i32, fixed));
  const Packing<Floats> pack(f, is_explained);
  const auto index = hn::Iota(i32, v * window.columns + u);
  hn::StoreU(pack(index), i32, counts->explained + counts->num_explained);
  hn::StoreU(pack(fixed), i32, counts->fits + counts->num_explained);
  counts->num_explained += Count(is_explained);
}

// Sorts measured pixels of which the solid is hit.
template <bool kIsCylinder>
HWY_INLINE void SortHits(const RaySolid& solid, const RayWindow& window, const RayLimits& limits,
                         const Pixels& pixels, const Mask& is_hit, const Vector3& ray_O,
                         const Passage& passage, int u, int v, RayCounts* counts) {
  const Floats f;
  const Ints i32;
  const Vector& z = pixels.z;
  const Vector3 p = PointInO(solid, ray_O, z);
  const FaceDistances q = DistancesToFaces<kIsCylinder>(solid, p);
  const auto tolerance = Tolerance(limits, z);
  const auto distance = SignedDistance<kIsCylinder>(q);
  const auto is_on = hn::And(hn::And(is_hit, hn::Lt(hn::Abs(distance), tolerance)),
                             hn::Ge(HeightAbove(solid.support, pixels), LeastHeight(limits, z)));
  if (!hn::AllFalse(f, is_on)) {
    Explain<kIsCylinder>(solid, window, limits, is_on, p, q, distance, tolerance, u, v, counts);
  }
  auto is_other = hn::AndNot(is_on, is_hit);
  const auto is_in_front = hn::Lt(z, passage.z_in);
  counts->num_occluded += Count(hn::And(is_other, is_in_front));
  is_other = hn::AndNot(is_in_front, is_other);
  if (hn::AllFalse(f, is_other)) return;
  if (kIsCylinder) {
    const auto is_hollow =
        hn::And(hn::And(is_other, passage.through_top), hn::Lt(distance, hn::Zero(f)));
    const auto index = hn::Iota(i32, v * window.columns + u);
    hn::StoreU(Packing<Floats>(f, is_hollow)(index), i32, counts->hollow + counts->num_hollow);
    counts->num_hollow += Count(is_hollow);
    is_other = hn::AndNot(is_hollow, is_other);
  }
  // However thin it is, nothing is behind what a ray goes through from end to end.
  const auto z_out = hn::IfThenElse(passage.through_ends, z, passage.z_out);
  const auto length = hn::Sub(hn::Min(z, z_out), passage.z_in);
  counts->num_violating += Count(hn::And(is_other, hn::Gt(length, tolerance)));
}

template <bool kIsCylinder>
HWY_INLINE void CastPixels(const RaySolid& solid, const RayWindow& window, const RayLimits& limits,
                           const RowRays& rays, int u, int v, RayCounts* counts) {
  const Floats f;
  const Pixels pixels = PixelsAt(window, u, v);
  const Vector3 ray_O = rays.At(solid.R_OC, pixels.ray_C.x);
  const Passage passage = PassageOf<kIsCylinder>(solid, ray_O);
  const auto is_hit = hn::And(pixels.is_seen, passage.is_hit());
  const auto height_O = hn::Add(Constant(solid.camera_O[2]), hn::Mul(pixels.z, ray_O.z));
  const auto from_top = hn::Abs(hn::Sub(height_O, Constant(solid.half_size[2])));
  const auto is_at_top = hn::AndNot(
      is_hit, hn::And(pixels.is_measured, hn::Le(from_top, Constant(limits.top_tolerance_m))));
  if (!hn::AllFalse(f, is_at_top)) {
    AppendOverhanging<kIsCylinder>(solid, window, limits, pixels, is_at_top, ray_O, u, v, counts);
  }
  if (hn::AllFalse(f, is_hit)) return;
  counts->num_unknown += Count(hn::AndNot(pixels.is_measured, is_hit));
  SortHits<kIsCylinder>(solid, window, limits, pixels, hn::And(is_hit, pixels.is_measured), ray_O,
                        passage, u, v, counts);
}

// Takes copies: what is behind a reference would be loaded anew after each store of a vector.
template <bool kIsCylinder>
HWY_INLINE void CastAll(const RaySolid solid, const RayWindow window, const RayLimits limits,
                        RayCounts* kept_counts) {
  RayCounts counts = *kept_counts;
  const int lanes = static_cast<int>(hn::Lanes(Floats()));
  for (int v = window.v_begin; v < window.v_end; ++v) {
    const RowRays rays(solid.R_OC, window.ray_y[v]);
    for (int u = window.u_begin; u < window.u_end; u += lanes) {
      CastPixels<kIsCylinder>(solid, window, limits, rays, u, v, &counts);
    }
  }
  *kept_counts = counts;
}

void CastWindow(const RaySolid& solid, const RayWindow& window, const RayLimits& limits,
                RayCounts* counts) {
  if (solid.is_cylinder) {
    CastAll<true>(solid, window, limits, counts);
  } else {
    CastAll<false>(solid, window, limits, counts);
  }
}

template <bool kIsCylinder>
HWY_INLINE int CountAllNear(const RaySolid& solid, const RayWindow& window, const RayLimits& limits,
                            float reach) {
  const Floats f;
  int num = 0;
  for (int v = window.v_begin; v < window.v_end; ++v) {
    for (int u = window.u_begin; u < window.u_end; u += static_cast<int>(hn::Lanes(f))) {
      const Pixels pixels = PixelsAt(window, u, v);
      const auto is_high = hn::And(pixels.is_measured, hn::Gt(HeightAbove(solid.support, pixels),
                                                              LeastHeight(limits, pixels.z)));
      if (hn::AllFalse(f, is_high)) continue;
      const Vector3 p = PointInO(solid, Rotate(solid.R_OC, pixels.ray_C), pixels.z);
      const auto distance = SignedDistance<kIsCylinder>(DistancesToFaces<kIsCylinder>(solid, p));
      num += Count(hn::And(is_high, hn::Lt(distance, Constant(reach))));
    }
  }
  return num;
}

template <bool kIsCylinder>
HWY_INLINE int CountAllInside(const RaySolid& solid, const SamplePoints& points, float min_depth) {
  const Floats f;
  int num = 0;
  for (size_t i = 0; i < points.num; i += hn::Lanes(f)) {
    const Vector3 x = {hn::LoadU(f, points.x + i), hn::LoadU(f, points.y + i),
                       hn::LoadU(f, points.z + i)};
    const Vector3 along = Rotate(points.axes, x);
    const Vector3 p = {hn::Add(Constant(points.origin[0]), along.x),
                       hn::Add(Constant(points.origin[1]), along.y),
                       hn::Add(Constant(points.origin[2]), along.z)};
    const FaceDistances q = DistancesToFaces<kIsCylinder>(solid, p);
    const auto deepest = kIsCylinder ? hn::Max(q.x, q.z) : hn::Max(hn::Max(q.x, q.y), q.z);
    num += Count(hn::And(hn::Lt(deepest, Constant(-min_depth)),
                         hn::FirstN(f, HWY_MIN(points.num - i, hn::Lanes(f)))));
  }
  return num;
}

int CountInside(const RaySolid& solid, const SamplePoints& points, float min_depth_m) {
  return solid.is_cylinder ? CountAllInside<true>(solid, points, min_depth_m)
                           : CountAllInside<false>(solid, points, min_depth_m);
}

int CountNear(const RaySolid& solid, const RayWindow& window, const RayLimits& limits,
              float reach_m) {
  return solid.is_cylinder ? CountAllNear<true>(solid, window, limits, reach_m)
                           : CountAllNear<false>(solid, window, limits, reach_m);
}

}  // namespace HWY_NAMESPACE
}  // namespace declutter
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace declutter {
namespace {

HWY_EXPORT(CastWindow);
HWY_EXPORT(CountInside);
HWY_EXPORT(CountNear);

}  // namespace

void CastWindow(const RaySolid& solid, const RayWindow& window, const RayLimits& limits,
                RayCounts* counts) {
  HWY_DYNAMIC_DISPATCH(CastWindow)(solid, window, limits, counts);
}

int CountInside(const RaySolid& solid, const SamplePoints& points, float min_depth_m) {
  return HWY_DYNAMIC_DISPATCH(CountInside)(solid, points, min_depth_m);
}

int CountNear(const RaySolid& solid, const RayWindow& window, const RayLimits& limits,
              float reach_m) {
  return HWY_DYNAMIC_DISPATCH(CountNear)(solid, window, limits, reach_m);
}

}  // namespace declutter
#endif
