#include "modules/codec/normal_code.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace declutter::codec {
namespace {

using Code = std::array<int8_t, 2>;

Code Encoded(const Eigen::Vector3f& normal) {
  Code code;
  EncodeNormals(&normal.x(), &normal.y(), &normal.z(), 1, &code[0], &code[1]);
  return code;
}

Eigen::Vector3f Decoded(const Code& code) {
  Eigen::Vector3f normal;
  DecodeNormals(&code[0], &code[1], 1, &normal.x(), &normal.y(), &normal.z());
  return normal;
}

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
    const Eigen::Vector3f decoded = Decoded(Encoded(normal));
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
    EXPECT_EQ(Decoded(Encoded(axis)), axis);
    EXPECT_EQ(Decoded(Encoded(-axis)), -axis);
  }
}

TEST(NormalCode, PutsNormalsTowardTheCameraInTheMiddle) {
  EXPECT_EQ(Encoded({0, 0, -1}), (Code{0, 0}));
}

TEST(NormalCode, KeepsTheUnknownNormal) {
  EXPECT_EQ(Encoded(Eigen::Vector3f::Zero()), (Code{kUnknownNormal, kUnknownNormal}));
  EXPECT_EQ(Decoded({kUnknownNormal, kUnknownNormal}), Eigen::Vector3f::Zero());
}

TEST(NormalCode, TellsCodesThatNoNormalHas) {
  EXPECT_TRUE(IsNormalCode(127, -127));
  EXPECT_TRUE(IsNormalCode(kUnknownNormal, kUnknownNormal));
  EXPECT_FALSE(IsNormalCode(-128, 0));
  EXPECT_FALSE(IsNormalCode(0, -128));
}

}  // namespace
}  // namespace declutter::codec
