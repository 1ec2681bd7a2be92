#pragma once

#include "modules/model_verifier/fit_kernels.h"

// Sums over the points of a solid that least squares need, by SIMD. Each is taken in sixteen parts,
// whatever the processor has: results are the same bits with every instruction set. Weights are
// inverse variances of the distance to the surface.
namespace declutter {

// Points of a face of a box: those at least edge_margin inside its edges, of which it is the
// nearest face.
struct FaceRegion {
  int axis = 0;
  int sign = 0;
  float half_size[3] = {};  // [m] of the box
  float edge_margin = 0;    // [m]
};

// x: [m] from the face to a point, along its axis. lever: by how much a yaw of the solid by 1 rad
// changes it.
struct FaceSums {
  int num = 0;
  double w = 0, wx = 0, wl = 0, wll = 0, wlx = 0;
};

FaceSums SumFace(const FitArrays& points, const FaceRegion& region);

// The side of a cylinder about (x, y) of O.
struct SideRegion {
  float x = 0, y = 0, radius = 0;  // [m]
  // Of the distance to the side, less where it is seen obliquely.
  float min_tolerance_m = 0, tolerance_in_sigmas = 0;
  float min_incidence_cos = 0;  // of the ray to the side, more than 0
  float min_normal_cos = 0;     // of a measured normal
};

// Of the distances r along the rays from the side to the points, by the cosine of incidence, whose
// derivatives by (x, y, radius) are (-nx, -ny, -1): (nx, ny) is the normal where a ray meets the
// side.
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
