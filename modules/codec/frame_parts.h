#pragma once

#include <Eigen/Geometry>
#include <array>

#include "modules/codec/checks.h"

// The parts that several messages share under the same field names: header, camera, poses, planes.
namespace declutter::codec {

template <typename Message>
void WriteHeader(const FrameHeader& header, Message* message) {
  message->utime = header.utime;
  message->frame = header.frame;
  message->error = header.error;
}

template <typename Message>
FrameHeader ReadHeader(const Message& message) {
  Check(message.utime >= 0, "utime", message.utime, "must not be negative");
  return {message.utime, message.frame, message.error};
}

template <typename Message>
void WriteCamera(const PinholeCamera& camera, Message* message) {
  message->width = camera.width;
  message->height = camera.height;
  message->fx = camera.fx;
  message->fy = camera.fy;
  message->cx = camera.cx;
  message->cy = camera.cy;
}

// All zero in a frame with an error.
template <typename Message>
PinholeCamera ReadCamera(const Message& message) {
  if (CheckImageSize(message.width, message.height, message.error) == 0) return {};
  return {message.width,
          message.height,
          Positive("fx", message.fx),
          Positive("fy", message.fy),
          Finite("cx", message.cx),
          Finite("cy", message.cy)};
}

// A pose as a message has it.
struct PoseNumbers {
  std::array<double, 4> q;  // w, x, y, z
  std::array<double, 3> p;  // [m]
};
// Where it stands in the message.
struct PoseFields {
  std::array<Field, 4> q;
  std::array<Field, 3> p;
};

PoseNumbers ToNumbers(const Eigen::Isometry3d& pose);
// Checks that q is a unit quaternion within 1e-3 and normalises it.
Eigen::Isometry3d ToPose(const PoseNumbers& numbers, const PoseFields& fields);

// The pose X_WC of the camera.
template <typename Message>
void WriteCameraPose(const Eigen::Isometry3d& X_WC, Message* message) {
  const PoseNumbers numbers = ToNumbers(X_WC);
  std::copy(numbers.q.begin(), numbers.q.end(), message->q_WC);
  std::copy(numbers.p.begin(), numbers.p.end(), message->p_WC);
}

template <typename Message>
Eigen::Isometry3d ReadCameraPose(const Message& message) {
  const auto& q = message.q_WC;
  const auto& p = message.p_WC;
  return ToPose({{q[0], q[1], q[2], q[3]}, {p[0], p[1], p[2]}},
                {{{{"q_WC", 0}, {"q_WC", 1}, {"q_WC", 2}, {"q_WC", 3}}},
                 {{{"p_WC", 0}, {"p_WC", 1}, {"p_WC", 2}}}});
}

template <typename Message>
void AppendPlane(const Plane& plane, Message* message) {
  message->normal_x.push_back(plane.normal.x());
  message->normal_y.push_back(plane.normal.y());
  message->normal_z.push_back(plane.normal.z());
  message->d.push_back(plane.d);
  message->num_planes = static_cast<int32_t>(message->d.size());
}

// Checks that the normal of plane i is a unit vector within 1e-3 and normalises it.
Plane ToPlane(const Eigen::Vector3d& normal, double d, size_t i);

// A frame with an error has no planes.
template <typename Message>
std::vector<Plane> ReadPlanes(const Message& message) {
  CheckLength("normal_x", message.normal_x, "num_planes", message.num_planes);
  CheckLength("normal_y", message.normal_y, "num_planes", message.num_planes);
  CheckLength("normal_z", message.normal_z, "num_planes", message.num_planes);
  CheckLength("d", message.d, "num_planes", message.num_planes);
  Check(message.error.empty() || message.num_planes == 0, "num_planes", message.num_planes,
        "must be 0 in a frame with an error");
  std::vector<Plane> planes;
  for (size_t i = 0; i < message.d.size(); ++i) {
    planes.push_back(
        ToPlane({message.normal_x[i], message.normal_y[i], message.normal_z[i]}, message.d[i], i));
  }
  return planes;
}

}  // namespace declutter::codec
