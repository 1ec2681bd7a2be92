#include "modules/model_verifier/normal_lookup.h"

#include <algorithm>
#include <cmath>

namespace declutter {
namespace {

constexpr int kStep = 2;                   // [px] between normals that are computed
constexpr double kReach = 0.012;           // [m] from a pixel to those its gradient is taken from
constexpr float kMaxInverseJump = 0.020f;  // [1/m] 7 counts of disparity: another surface

}  // namespace

NormalLookup::NormalLookup(const DepthImage& image)
    : image_(image),
      is_known_(image.counts.size(), 0),
      normals_(image.counts.size(), Eigen::Vector3f::Zero()) {}

const Eigen::Vector3f& NormalLookup::At(int u, int v) const {
  u -= u % kStep;
  v -= v % kStep;
  const size_t i =
      static_cast<size_t>(v) * static_cast<size_t>(image_.camera.width) + static_cast<size_t>(u);
  if (!is_known_[i]) {
    is_known_[i] = 1;
    normals_[i] = Compute(u, v);
  }
  return normals_[i];
}

float NormalLookup::MeanInverseDepth(int u, int v) const {
  const PinholeCamera& camera = image_.camera;
  if (u < 1 || v < 1 || u >= camera.width - 1 || v >= camera.height - 1) return 0;
  const auto centre = static_cast<float>(image_.DepthAt(u, v));
  if (centre <= 0) return 0;
  float sum = 0;
  int num = 0;
  for (int dv = -1; dv <= 1; ++dv) {
    for (int du = -1; du <= 1; ++du) {
      const auto z = static_cast<float>(image_.DepthAt(u + du, v + dv));
      if (z <= 0 || std::abs(1 / z - 1 / centre) > kMaxInverseJump) continue;
      sum += 1 / z;
      ++num;
    }
  }
  return sum / static_cast<float>(num);
}

Eigen::Vector3f NormalLookup::Compute(int u, int v) const {
  const PinholeCamera& camera = image_.camera;
  const double z = image_.DepthAt(u, v);
  if (z <= 0) return Eigen::Vector3f::Zero();
  const int reach = std::clamp(static_cast<int>(std::lround(kReach * camera.fx / z)), 2, 16);
  const float left = MeanInverseDepth(u - reach, v);
  const float right = MeanInverseDepth(u + reach, v);
  const float up = MeanInverseDepth(u, v - reach);
  const float down = MeanInverseDepth(u, v + reach);
  const auto here = static_cast<float>(1 / z);
  // On one smooth surface the middle lies between both sides.
  const auto is_smooth = [here](float a, float b) {
    return a > 0 && b > 0 && std::abs(0.5f * (a + b) - here) < 0.5f * kMaxInverseJump;
  };
  if (!is_smooth(left, right) || !is_smooth(up, down)) return Eigen::Vector3f::Zero();
  const auto baseline = static_cast<float>(2 * reach);
  const float du = (right - left) / baseline;
  const float dv = (down - up) / baseline;
  // n . ray = c / z on a plane, so the gradient of 1 / z is n in pixel coordinates.
  Eigen::Vector3f n(du * static_cast<float>(camera.fx), dv * static_cast<float>(camera.fy), 0);
  const Eigen::Vector3f ray = camera.Ray(u, v).cast<float>();
  n.z() = here - n.x() * ray.x() - n.y() * ray.y();
  return -n.normalized();
}

}  // namespace declutter
