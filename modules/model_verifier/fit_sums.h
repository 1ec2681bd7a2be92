#pragma once

#include "modules/model_verifier/fit_kernels.h"

// Sums over the points of a solid that least squares need, by SIMD. Each is taken in sixteen parts,
// whatever the processor has: results are the same bits with every instruction set. Weights are
// inverse variances of the distance to the surface.
namespace declutter {

// Points of a face whose coordinates along the other axes are at most `inner` [m].
struct FaceRegion {
  int axis = 0;
  int sign = 0;
  float place = 0;  // [m] coordinate of the face along its axis
  float inner[3] = {};
};

// x: [m] from the face to a point, along its axis. lever: by how much a yaw of the solid by 1 rad
// changes it.
struct FaceSums {
  int num = 0;
  double w = 0, wx = 0, wl = 0, wll = 0, wlx = 0;
};

FaceSums SumFace(const FitArrays& points, const FaceRegion& region);

// Strips of a face across one of its axes, along which coordinates are taken as `sign` times those
// of O. Points farther than half_across from the middle of the other axis do not count.
struct FaceStrips {
  int face_axis = 0, face_sign = 0;
  int axis = 0, sign = 0;
  float half_across = 0;      // [m]
  float reference_begin = 0;  // [m] where the first strip begins,
  float begin = 0, end = 0;   // where it ends and the second one begins, and where that ends
};

struct StripAreas {
  int num = 0;            // points of the face
  int num_reference = 0;  // in the first strip
  double reference = 0;   // [m^2] area of the first
  double beyond = 0;      // and of the second
};

StripAreas SumStrips(const FitArrays& points, const FaceStrips& strips);

// The side of a cylinder about (x, y) of O.
struct SideRegion {
  float x = 0, y = 0, radius = 0;                      // [m]
  float min_tolerance_m = 0, tolerance_in_sigmas = 0;  // of the distance to the side
  float min_incidence_cos = 0;                         // of the ray to the side
  float min_normal_cos = 0;                            // of a measured normal
};

// Of the distances r to the side, whose derivatives by (x, y, radius) are (-nx, -ny, -1).
struct SideSums {
  int num = 0;
  double w = 0, nx = 0, ny = 0, nxnx = 0, nxny = 0, nyny = 0, r = 0, nxr = 0, nyr = 0;  // times w
};

SideSums SumSide(const FitArrays& points, const SideRegion& region);

// The upper end of a cylinder about (x, y) of O, up to a radius.
struct DiscRegion {
  float x = 0, y = 0, radius = 0;  // [m]
  float height = 0;                // [m] coordinate of the end
};

struct DiscSums {
  int num = 0;
  double w = 0, wz = 0;  // z: [m] above the end
};

DiscSums SumDisc(const FitArrays& points, const DiscRegion& region);

}  // namespace declutter
