#include "modules/model_verifier/end_evidence.h"

#include <algorithm>
#include <cmath>

#include "modules/model_verifier/extents.h"
#include "modules/model_verifier/support_settling.h"
#include "modules/model_verifier/surface_fit.h"

namespace declutter {
namespace {

constexpr double kBeyond = 0.010;  // [m] from an end to where its surroundings are probed
constexpr int kProbes = 9;         // along each edge
constexpr double kInset = 0.85;    // of the half size, up to which an edge is probed
// Along the edges of a face: of its extent, and at most [m].
constexpr double kFaceMargin = 0.25, kMaxFaceMargin = 0.005;

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

bool IsEdgeSeen(const Solid& solid, const DepthImage& image, int axis, int sign) {
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

// [px] explained on each face, off its edges: a point at an edge may be one of the other face.
std::array<std::array<int, 2>, 3> PointsOnFaces(const Solid& solid, const RayEvidence& evidence,
                                                const std::vector<Eigen::Vector3d>& points_O) {
  std::array<std::array<int, 2>, 3> num = {};
  const Eigen::Array3d half = 0.5 * solid.size.array();
  const Eigen::Array3d inner = half - (kFaceMargin * solid.size.array()).min(kMaxFaceMargin);
  for (const Eigen::Vector3d& p_O : points_O) {
    int axis = 0;
    (p_O.array().abs() - half).maxCoeff(&axis);
    Eigen::Array3d along = p_O.array().abs();
    along[axis] = 0;
    if ((along > inner).any()) continue;
    num[static_cast<size_t>(axis)][p_O[axis] > 0] += evidence.pixel_weight;
  }
  return num;
}

}  // namespace

SolidEnds EndsOf(const Solid& solid, const std::array<Evidence, 3>& given,
                 const RayEvidence& evidence, const std::vector<Eigen::Vector3d>& points_O,
                 const Observation& observation, RayEvidence* buffer) {
  SolidEnds ends = {};
  if (solid.shape == Shape::kCylinder) {
    ends[2] = {given[2] == Evidence::kAssumed ? EndEvidence::kAssumed : EndEvidence::kSupport,
               EndEvidence::kEdge};
    return ends;
  }
  const auto num_points = PointsOnFaces(solid, evidence, points_O);
  const Eigen::Vector3d camera_O = solid.X_CO.inverse().translation();
  const bool is_standing = IsUpright(solid, observation.support);
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const auto a = static_cast<size_t>(axis);
      const auto s = static_cast<size_t>(side);
      const int sign = side == 0 ? -1 : 1;
      EndEvidence& end = ends[a][s];
      const bool was_assumed = given[a] == Evidence::kAssumed;
      if (is_standing && axis == 2 && side == 0) {
        end = was_assumed ? EndEvidence::kAssumed : EndEvidence::kSupport;
      } else if (num_points[a][s] >= kMinFitPoints && FacesCamera(solid, camera_O, axis, sign)) {
        end = EndEvidence::kFace;
      } else if ((is_standing && axis == 2) ||
                 (!was_assumed && IsEdgeSeen(solid, observation.image, axis, sign))) {
        end = EndEvidence::kEdge;
      } else {
        const Solid longer = Longer(solid, axis, sign, kFreeSpaceReach);
        CastRays(longer, observation, buffer);
        end = buffer->num_violating >= evidence.num_violating + kMinViolating
                  ? EndEvidence::kFreeSpace
                  : EndEvidence::kAssumed;
      }
    }
  }
  return ends;
}

std::array<Evidence, 3> ExtentEvidence(const SolidEnds& ends) {
  std::array<Evidence, 3> evidence = {};
  for (size_t axis = 0; axis < 3; ++axis) {
    switch (std::max(ends[axis][0], ends[axis][1])) {
      case EndEvidence::kAssumed:
        evidence[axis] = Evidence::kAssumed;
        break;
      case EndEvidence::kFreeSpace:
        evidence[axis] = Evidence::kFreeSpace;
        break;
      default:
        evidence[axis] = Evidence::kObserved;
    }
  }
  return evidence;
}

}  // namespace declutter
