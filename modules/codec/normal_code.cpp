#include "modules/codec/normal_code.h"

#include <cmath>

namespace declutter::codec {
namespace {

constexpr float kSteps = 127;

// Folds the lower half of the octahedron, z < 0, over the upper one's outer triangles, and back.
Eigen::Vector2f Fold(const Eigen::Vector2f& p) {
  return {std::copysign(1 - std::abs(p.y()), p.x()), std::copysign(1 - std::abs(p.x()), p.y())};
}

}  // namespace

NormalCode EncodeNormal(const Eigen::Vector3f& normal) {
  if (normal.isZero(0)) return kUnknownNormal;
  const Eigen::Vector3f on_octahedron = -normal / normal.lpNorm<1>();
  Eigen::Vector2f p = on_octahedron.head<2>();
  if (on_octahedron.z() < 0) p = Fold(p);
  return {static_cast<int8_t>(std::lround(kSteps * p.x())),
          static_cast<int8_t>(std::lround(kSteps * p.y()))};
}

Eigen::Vector3f DecodeNormal(const NormalCode& code) {
  if (code == kUnknownNormal) return Eigen::Vector3f::Zero();
  Eigen::Vector2f p(static_cast<float>(code[0]) / kSteps, static_cast<float>(code[1]) / kSteps);
  const float z = 1 - p.lpNorm<1>();
  if (z < 0) p = Fold(p);
  return -Eigen::Vector3f(p.x(), p.y(), z).normalized();
}

}  // namespace declutter::codec
