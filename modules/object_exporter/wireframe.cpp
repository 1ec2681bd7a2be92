#include "modules/object_exporter/wireframe.h"

#include <cmath>

namespace declutter {
namespace {

using Eigen::Vector3d;

constexpr int kPiecesPerEdge = 24;
constexpr int kPiecesPerCircle = 72;

// A face through p_C with that outward normal is seen from the origin of C.
bool IsSeen(const Vector3d& normal_C, const Vector3d& p_C) { return normal_C.dot(p_C) < 0; }

void AddEdge(const Vector3d& from_C, const Vector3d& to_C, bool faces_camera,
             std::vector<WireSegment>* segments) {
  const Vector3d step = (to_C - from_C) / kPiecesPerEdge;
  for (int i = 0; i < kPiecesPerEdge; ++i) {
    segments->push_back({from_C + i * step, from_C + (i + 1) * step, faces_camera});
  }
}

std::vector<WireSegment> BoxWireframe(const Solid& box) {
  std::vector<WireSegment> segments;
  const Eigen::Matrix3d axes_C = box.X_CO.linear();
  const auto is_seen = [&](int axis, int side) {
    const Vector3d normal_C = side * axes_C.col(axis);
    return IsSeen(normal_C, box.X_CO.translation() + normal_C * box.size[axis] / 2);
  };
  for (int along = 0; along < 3; ++along) {
    const int a = (along + 1) % 3;
    const int b = (along + 2) % 3;
    for (const int side_a : {-1, 1}) {
      for (const int side_b : {-1, 1}) {
        Vector3d end_O = Vector3d::Zero();
        end_O[a] = side_a * box.size[a] / 2;
        end_O[b] = side_b * box.size[b] / 2;
        end_O[along] = box.size[along] / 2;
        Vector3d start_O = end_O;
        start_O[along] = -end_O[along];
        AddEdge(box.X_CO * start_O, box.X_CO * end_O, is_seen(a, side_a) || is_seen(b, side_b),
                &segments);
      }
    }
  }
  return segments;
}

void AddCircle(const Solid& cylinder, int side, std::vector<WireSegment>* segments) {
  const double z_O = side * cylinder.height() / 2;
  const Vector3d normal_C = side * cylinder.X_CO.linear().col(2);
  const bool cap_is_seen = IsSeen(normal_C, cylinder.X_CO * Vector3d(0, 0, z_O));
  const auto direction_O = [](double step) {
    const double angle_rad = 2 * M_PI * step / kPiecesPerCircle;
    return Vector3d(std::cos(angle_rad), std::sin(angle_rad), 0);
  };
  const auto point_C = [&](double step) -> Vector3d {
    return cylinder.X_CO * (cylinder.radius() * direction_O(step) + Vector3d(0, 0, z_O));
  };
  for (int i = 0; i < kPiecesPerCircle; ++i) {
    const Vector3d side_normal_C = cylinder.X_CO.linear() * direction_O(i + 0.5);
    segments->push_back(
        {point_C(i), point_C(i + 1), cap_is_seen || IsSeen(side_normal_C, point_C(i + 0.5))});
  }
}

// The side turns away where its normal n is square to the line of sight: n . (p_O - radius n) = 0
// for the camera at p_O in the plane of the circle.
void AddSilhouettes(const Solid& cylinder, std::vector<WireSegment>* segments) {
  const Vector3d camera_O = cylinder.X_CO.inverse() * Vector3d::Zero();
  const double distance = camera_O.head<2>().norm();
  if (distance <= cylinder.radius()) return;
  const double toward_camera_rad = std::atan2(camera_O.y(), camera_O.x());
  const double turn_rad = std::acos(cylinder.radius() / distance);
  for (const double angle_rad : {toward_camera_rad - turn_rad, toward_camera_rad + turn_rad}) {
    Vector3d top_O = cylinder.radius() * Vector3d(std::cos(angle_rad), std::sin(angle_rad), 0);
    top_O.z() = cylinder.height() / 2;
    const Vector3d bottom_O(top_O.x(), top_O.y(), -top_O.z());
    AddEdge(cylinder.X_CO * bottom_O, cylinder.X_CO * top_O, true, segments);
  }
}

}  // namespace

std::vector<WireSegment> Wireframe(const Solid& solid) {
  if (solid.shape == Shape::kBox) return BoxWireframe(solid);
  std::vector<WireSegment> segments;
  for (const int side : {-1, 1}) AddCircle(solid, side, &segments);
  AddSilhouettes(solid, &segments);
  return segments;
}

}  // namespace declutter
