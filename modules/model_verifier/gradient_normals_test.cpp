#include "modules/model_verifier/gradient_normals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <hwy/targets.h>

#include <random>

#include "modules/model_verifier/observation.h"

namespace declutter {
namespace {

constexpr PinholeCamera kCamera = {67, 48, 60, 60, 31.5, 23.5};

// An image of the plane z = 1 + slope * x.
DepthImage SlopedWall(double slope) {
  DepthImage image;
  image.camera = kCamera;
  image.depth_scale_m = 0.0001;
  for (int v = 0; v < kCamera.height; ++v) {
    for (int u = 0; u < kCamera.width; ++u) {
      const double z = 1 / (1 - slope * kCamera.Ray(u, v).x());
      image.counts.push_back(static_cast<uint16_t>(std::lround(z / image.depth_scale_m)));
    }
  }
  return image;
}

const Plane kSupport = {-Eigen::Vector3d::UnitZ(), 5.0};

TEST(GradientNormals, GivesTheNormalOfAPlane) {
  const DepthImage image = SlopedWall(0.5);
  ObservedImage observed;
  observed.Set(image, kSupport);
  const Eigen::Vector3f normal = observed.every_pixel().normals.At(30, 24);
  const Eigen::Vector3f truth = Eigen::Vector3f(0.5f, 0, -1).normalized();
  EXPECT_GT(normal.dot(truth), 0.9999);
}

TEST(GradientNormals, IsZeroAtAJumpAtABorderAndWithoutDepth) {
  DepthImage image = SlopedWall(0);
  for (int v = 0; v < kCamera.height; ++v) {
    for (int u = 40; u < kCamera.width; ++u) {
      image.counts[static_cast<size_t>(v * kCamera.width + u)] = v < 24 ? 15000 : 0;
    }
  }
  ObservedImage observed;
  observed.Set(image, kSupport);
  const GradientNormals& normals = observed.every_pixel().normals;
  EXPECT_FALSE(normals.At(20, 24).isZero());
  EXPECT_TRUE(normals.At(39, 20).isZero());
  EXPECT_TRUE(normals.At(0, 24).isZero());
  EXPECT_TRUE(normals.At(20, 47).isZero());
  EXPECT_TRUE(normals.At(50, 30).isZero());
}

TEST(GradientNormals, IsTheSameWithEveryInstructionSet) {
  DepthImage image = SlopedWall(0.2);
  std::mt19937 random(3);
  for (uint16_t& count : image.counts) {
    count = random() % 9 == 0 ? 0 : static_cast<uint16_t>(count + random() % 50);
  }
  std::vector<float> first;
  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().DeInit();
    ObservedImage observed;
    observed.Set(image, kSupport);
    const GradientNormals& normals = observed.every_pixel().normals;
    std::vector<float> all;
    for (int v = 0; v < kCamera.height; v += 2) {
      for (int u = 0; u < kCamera.width; u += 2) {
        const Eigen::Vector3f n = normals.At(u, v);
        all.insert(all.end(), {n.x(), n.y(), n.z()});
      }
    }
    if (first.empty()) first = all;
    EXPECT_EQ(all, first) << hwy::TargetName(target);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}

}  // namespace
}  // namespace declutter
