#include "modules/codec/normal_code.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace declutter::codec {
namespace {

double Angle_deg(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / M_PI;
}

TEST(NormalCode, KeepsEveryDirectionWithinOneDegree) {
  double max_error_deg = 0;
  double sum_deg = 0;
  const int num = 200'000;
  // Points of a spiral that covers the sphere evenly.
  for (int i = 0; i < num; ++i) {
    const double z = 1 - (2 * i + 1.0) / num;
    const double r = std::sqrt(1 - z * z);
    const double angle = i * 2.399963229728653;
    const Eigen::Vector3f normal =
        Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), z).cast<float>();
    const Eigen::Vector3f decoded = DecodeNormal(EncodeNormal(normal));
    ASSERT_NEAR(decoded.norm(), 1, 1e-6);
    max_error_deg = std::max(max_error_deg, Angle_deg(normal, decoded));
    sum_deg += Angle_deg(normal, decoded);
  }
  EXPECT_LE(max_error_deg, 1.0);
  EXPECT_LE(sum_deg / num, 0.34);
}

TEST(NormalCode, IsExactAlongTheAxes) {
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3f axis = Eigen::Vector3f::Unit(i);
    EXPECT_EQ(DecodeNormal(EncodeNormal(axis)), axis);
    EXPECT_EQ(DecodeNormal(EncodeNormal(-axis)), -axis);
  }
}

TEST(NormalCode, PutsNormalsTowardTheCameraInTheMiddle) {
  EXPECT_EQ(EncodeNormal({0, 0, -1}), (NormalCode{0, 0}));
}

TEST(NormalCode, KeepsTheUnknownNormal) {
  EXPECT_EQ(EncodeNormal(Eigen::Vector3f::Zero()), kUnknownNormal);
  EXPECT_EQ(DecodeNormal(kUnknownNormal), Eigen::Vector3f::Zero());
}

TEST(NormalCode, TellsCodesThatNoNormalHas) {
  EXPECT_TRUE(IsNormalCode({127, -127}));
  EXPECT_TRUE(IsNormalCode(kUnknownNormal));
  EXPECT_FALSE(IsNormalCode({-128, 0}));
  EXPECT_FALSE(IsNormalCode({0, -128}));
}

}  // namespace
}  // namespace declutter::codec
