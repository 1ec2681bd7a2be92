#include "modules/codec/frame_parts.h"

#include <cmath>

namespace declutter::codec {
namespace {

// Rounding to float32 and back leaves 1e-7; what is this far off was never a unit vector.
constexpr double kMaxNormError = 1e-3;

}  // namespace

PoseNumbers ToNumbers(const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(pose.linear()).normalized();
  const Eigen::Vector3d p = pose.translation();
  return {{q.w(), q.x(), q.y(), q.z()}, {p.x(), p.y(), p.z()}};
}

Eigen::Isometry3d ToPose(const PoseNumbers& numbers, const PoseFields& fields) {
  for (size_t i = 0; i < 4; ++i) Finite(fields.q[i], numbers.q[i]);
  for (size_t i = 0; i < 3; ++i) Finite(fields.p[i], numbers.p[i]);
  const Eigen::Quaterniond q(numbers.q[0], numbers.q[1], numbers.q[2], numbers.q[3]);
  Check(std::abs(q.norm() - 1) <= kMaxNormError, fields.q[0], numbers.q[0],
        "begins a quaternion that is not a unit quaternion");
  return Eigen::Translation3d(numbers.p[0], numbers.p[1], numbers.p[2]) * q.normalized();
}

Plane ToPlane(const Eigen::Vector3d& normal, double d, size_t i) {
  Finite({"normal_x", i}, normal.x());
  Finite({"normal_y", i}, normal.y());
  Finite({"normal_z", i}, normal.z());
  Check(std::abs(normal.norm() - 1) <= kMaxNormError, {"normal_x", i}, normal.x(),
        "begins a normal that is not a unit vector");
  return {normal.normalized(), Positive({"d", i}, d)};
}

}  // namespace declutter::codec
