#include "modules/model_verifier/extent_evidence.h"

#include <cmath>

#include "modules/model_verifier/ray_casting.h"

namespace declutter {
namespace {

constexpr double kBeyond = 0.010;  // [m] from an end to where its surroundings are probed
constexpr int kProbes = 9;         // along each edge
constexpr double kInset = 0.85;    // of the half size, up to which an edge is probed

struct Votes {
  int seen = 0;    // free space behind the edge
  int hidden = 0;  // something in front, or the surface goes on
};

// Looks past a point of C just beyond an edge.
void Probe(const Eigen::Vector3d& p_C, const DepthImage& image, Votes* votes) {
  if (p_C.z() <= 0) return;
  const Eigen::Vector2d pixel = image.camera.Project(p_C);
  const int u = static_cast<int>(std::lround(pixel.x()));
  const int v = static_cast<int>(std::lround(pixel.y()));
  if (u < 0 || v < 0 || u >= image.camera.width || v >= image.camera.height) {
    ++votes->hidden;
    return;
  }
  const double z = image.DepthAt(u, v);
  if (z <= 0) return;
  ++(z > p_C.z() + SurfaceTolerance(z) ? votes->seen : votes->hidden);
}

// The face `sign` of an axis of O is turned toward the camera, which is at p_O.
bool FacesCamera(const Solid& solid, const Eigen::Vector3d& camera_O, int axis, int sign) {
  return sign * camera_O[axis] > 0.5 * solid.size[axis];
}

bool IsEndSeen(const Solid& solid, const DepthImage& image, int axis, int sign) {
  const Eigen::Vector3d half = 0.5 * solid.size;
  const Eigen::Vector3d camera_O = solid.X_CO.inverse().translation();
  Votes votes;
  for (int face = 0; face < 3; ++face) {
    if (face == axis) continue;
    for (int face_sign : {-1, 1}) {
      if (!FacesCamera(solid, camera_O, face, face_sign)) continue;
      const int along = 3 - axis - face;
      for (int i = 0; i < kProbes; ++i) {
        Eigen::Vector3d p_O;
        p_O[axis] = sign * (half[axis] + kBeyond);
        p_O[face] = face_sign * half[face];
        p_O[along] = kInset * half[along] * (2.0 * i / (kProbes - 1) - 1);
        Probe(solid.X_CO * p_O, image, &votes);
      }
    }
  }
  return votes.seen > votes.hidden;
}

}  // namespace

std::array<Evidence, 3> ExtentEvidence(const Solid& solid, const std::array<Evidence, 3>& given,
                                       const DepthImage& image) {
  std::array<Evidence, 3> evidence = given;
  if (solid.shape == Shape::kCylinder) return evidence;
  for (size_t axis = 0; axis < 2; ++axis) {
    for (int sign : {-1, 1}) {
      if (!IsEndSeen(solid, image, static_cast<int>(axis), sign)) {
        evidence[axis] = Evidence::kAssumed;
      }
    }
  }
  return evidence;
}

}  // namespace declutter
