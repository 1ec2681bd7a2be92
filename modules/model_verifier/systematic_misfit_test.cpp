#include "modules/model_verifier/systematic_misfit.h"

#include <gtest/gtest.h>

#include <cmath>

namespace declutter {
namespace {

constexpr double kRadius = 0.03;  // [m]
constexpr double kHeight = 0.10;  // [m]

// A solid that is seen from -y of O, 0.8 m away.
Solid SolidOf(Shape shape, const Eigen::Vector3d& size) {
  Solid solid;
  solid.shape = shape;
  solid.X_CO =
      Eigen::Translation3d(0, 0, 0.8) * Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitX());
  solid.size = size;
  return solid;
}

// Points on the part of a cylinder that faces -y, where it is not seen too obliquely.
std::vector<Eigen::Vector3d> RoundSide() {
  std::vector<Eigen::Vector3d> points_O;
  for (double angle = -0.8; angle <= 0.8; angle += 0.05) {
    for (double z = -0.04; z <= 0.04; z += 0.004) {
      points_O.emplace_back(kRadius * std::sin(angle), -kRadius * std::cos(angle), z);
    }
  }
  return points_O;
}

std::vector<Eigen::Vector3d> FlatSide() {
  std::vector<Eigen::Vector3d> points_O;
  for (double x = -0.022; x <= 0.022; x += 0.001) {
    for (double z = -0.04; z <= 0.04; z += 0.004) points_O.emplace_back(x, -0.0275, z);
  }
  return points_O;
}

TEST(SystematicMisfit, TellsARoundSideFromAFlatOne) {
  const Solid cylinder = SolidOf(Shape::kCylinder, {2 * kRadius, 2 * kRadius, kHeight});
  const Solid box = SolidOf(Shape::kBox, {0.06, 0.055, kHeight});
  EXPECT_LT(SystematicMisfit(cylinder, RoundSide()), 1e-6);
  EXPECT_LT(SystematicMisfit(box, FlatSide()), 1e-6);
  EXPECT_GT(SystematicMisfit(cylinder, FlatSide()), 0.0015);
  EXPECT_GT(SystematicMisfit(box, RoundSide()), 0.0015);
}

TEST(TaperOf, IsTheSlopeOfACone) {
  std::vector<Eigen::Vector3d> points_O = RoundSide();
  for (Eigen::Vector3d& p : points_O) p.head<2>() *= 1 - 0.2 * p.z() / kRadius;
  const Solid cylinder = SolidOf(Shape::kCylinder, {2 * kRadius, 2 * kRadius, kHeight});
  EXPECT_NEAR(TaperOf(cylinder, points_O, 0.001).slope, -0.2, 1e-6);
  EXPECT_NEAR(TaperOf(cylinder, RoundSide(), 0.001).slope, 0, 1e-6);
  EXPECT_GT(TaperOf(cylinder, RoundSide(), 0.001).sd, 0.001);
}

TEST(LayerMisfit, TellsABodyWithAWaist) {
  std::vector<Eigen::Vector3d> points_O = RoundSide();
  const Solid cylinder = SolidOf(Shape::kCylinder, {2 * kRadius, 2 * kRadius, kHeight});
  EXPECT_LT(LayerMisfit(cylinder, points_O), 1e-6);
  for (Eigen::Vector3d& p : points_O) p.head<2>() *= 0.9 + 0.1 * std::abs(p.z()) / 0.04;
  EXPECT_GT(LayerMisfit(cylinder, points_O), 0.0007);
}

TEST(StepOf, IsWhereAWiderCylinderBegins) {
  std::vector<Eigen::Vector3d> points_O = RoundSide();
  for (Eigen::Vector3d& p : points_O) {
    if (p.z() < -0.01) p.head<2>() *= 1.1;
  }
  const Solid cylinder = SolidOf(Shape::kCylinder, {2 * kRadius, 2 * kRadius, kHeight});
  const auto step = StepOf(cylinder, points_O);
  ASSERT_TRUE(step);
  EXPECT_NEAR(*step, -0.01, 0.004);
  EXPECT_FALSE(StepOf(cylinder, {}));
}

TEST(SystematicMisfit, LeavesOutTheTopWhereNoiseLowersIt) {
  std::vector<Eigen::Vector3d> points_O = RoundSide();
  for (double x = -0.02; x <= 0.02; x += 0.002) points_O.emplace_back(x, 0, 0.5 * kHeight - 0.008);
  const Solid cylinder = SolidOf(Shape::kCylinder, {2 * kRadius, 2 * kRadius, kHeight});
  EXPECT_LT(SystematicMisfit(cylinder, points_O), 1e-6);
  EXPECT_LT(LayerMisfit(cylinder, points_O), 1e-6);
  EXPECT_NEAR(TaperOf(cylinder, points_O, 0.001).slope, 0, 1e-6);
}

TEST(MisfitShare, IsNothingForNoiseAndBoundedForEverything) {
  EXPECT_EQ(MisfitShare(0.3), 0);
  EXPECT_GT(MisfitShare(0.8), 0.1);
  EXPECT_EQ(MisfitShare(5), MisfitShare(50));
}

TEST(SystematicMisfit, SaysNothingOfASideWithoutPoints) {
  EXPECT_EQ(SystematicMisfit(SolidOf(Shape::kCylinder, {0.06, 0.06, kHeight}), {}), 0);
}

}  // namespace
}  // namespace declutter
