#include "tests/accuracy/radius_bound.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace declutter::accuracy {
namespace {

constexpr PinholeCamera kCamera = {640, 480, 525, 525, 319.5, 239.5};

// 0.9 m away, its axis across the line of sight.
Solid Can() {
  Solid can;
  can.shape = Shape::kCylinder;
  can.X_CO.translation() = Eigen::Vector3d(0, 0, 0.94);
  can.X_CO.linear() = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitX()).toRotationMatrix();
  can.size = Eigen::Vector3d(0.08, 0.08, 0.1);
  return can;
}

// Of columns u_begin .. u_end.
std::vector<int> Pixels(int u_begin, int u_end) {
  std::vector<int> pixels;
  for (int v = 0; v < kCamera.height; ++v) {
    for (int u = u_begin; u < u_end; ++u) pixels.push_back(v * kCamera.width + u);
  }
  return pixels;
}

SceneNoise NoiseOf(const char* model) {
  SceneNoise noise;
  noise.set_model(model);
  return noise;
}

TEST(RadiusBound, IsThatOfEverySideSeenAlike) {
  // With N pixels that see sin(incidence) spread evenly up to S, the information on the radius
  // beside an unknown depth of the axis is N (atanh(S) / S - (asin(S) / S)^2) / sigma^2.
  constexpr double kMaxSine = 0.978, kNum = 2590, kSigma = 0.00187;
  const double information =
      kNum * (std::atanh(kMaxSine) / kMaxSine - std::pow(std::asin(kMaxSine) / kMaxSine, 2));
  const auto bound = RadiusBound(Can(), kCamera, Pixels(0, 640), NoiseOf("white"));
  ASSERT_TRUE(bound);
  EXPECT_NEAR(*bound, kSigma / std::sqrt(information), 0.1 * *bound);
}

TEST(RadiusBound, IsLargerTheLessOfTheSideIsSeen) {
  const SceneNoise noise = NoiseOf("white");
  const auto all = RadiusBound(Can(), kCamera, Pixels(0, 640), noise);
  const auto half = RadiusBound(Can(), kCamera, Pixels(320, 640), noise);
  ASSERT_TRUE(all && half);
  EXPECT_GT(*half, 2 * *all);
  EXPECT_FALSE(RadiusBound(Can(), kCamera, Pixels(0, 100), noise));
}

TEST(RadiusBound, CountsPixelsThatShareTheirErrorsAsOne) {
  SceneNoise noise = NoiseOf("real_sensor");
  const auto bound = RadiusBound(Can(), kCamera, Pixels(0, 640), noise);
  noise.set_noise_width_px(2 * noise.noise_width_px());
  noise.set_noise_height_px(2 * noise.noise_height_px());
  const auto of_larger = RadiusBound(Can(), kCamera, Pixels(0, 640), noise);
  ASSERT_TRUE(bound && of_larger);
  EXPECT_NEAR(*of_larger, 2 * *bound, 1e-9);
}

TEST(RadiusBound, IsNoneWithoutNoise) {
  EXPECT_FALSE(RadiusBound(Can(), kCamera, Pixels(0, 640), NoiseOf("none")));
}

}  // namespace
}  // namespace declutter::accuracy
