#include "tests/accuracy/solid_comparison.h"

#include <gtest/gtest.h>

#include <cmath>

namespace declutter::accuracy {
namespace {

Solid Box(double x, double y, double z) {
  Solid solid;
  solid.shape = Shape::kBox;
  solid.size = {x, y, z};
  return solid;
}

Solid Cylinder(double radius, double height) {
  Solid solid;
  solid.shape = Shape::kCylinder;
  solid.size = {2 * radius, 2 * radius, height};
  return solid;
}

void Turn(Solid* solid, double angle_rad, const Eigen::Vector3d& axis) {
  solid->X_CO.rotate(Eigen::AngleAxisd(angle_rad, axis));
}

TEST(CompareSolids, FindsNoErrorInABoxDescribedByOtherAxes) {
  const Solid truth = Box(0.10, 0.20, 0.30);
  Solid model = Box(0.20, 0.10, 0.30);
  Turn(&model, M_PI / 2, Eigen::Vector3d::UnitZ());
  const SolidError error = CompareSolids(model, truth);
  EXPECT_NEAR(error.extent.norm(), 0, 1e-12);
  EXPECT_NEAR(error.yaw_rad, 0, 1e-6);
  EXPECT_NEAR(error.volume_iou, 1, 1e-9);
}

TEST(CompareSolids, MeasuresExtentsAlongTheAxesOfTheTrueBox) {
  const Solid truth = Box(0.10, 0.20, 0.30);
  Solid model = Box(0.31, 0.19, 0.10);  // its z along x of the truth
  Turn(&model, M_PI / 2, Eigen::Vector3d::UnitY());
  const SolidError error = CompareSolids(model, truth);
  EXPECT_NEAR(error.extent.x(), 0.00, 1e-12);
  EXPECT_NEAR(error.extent.y(), -0.01, 1e-12);
  EXPECT_NEAR(error.extent.z(), 0.01, 1e-12);
  EXPECT_EQ(error.axis[0], 2);
}

TEST(CompareSolids, MeasuresTheYawOfABox) {
  const Solid truth = Box(0.10, 0.20, 0.30);
  Solid model = truth;
  Turn(&model, 0.1, Eigen::Vector3d::UnitZ());
  EXPECT_NEAR(CompareSolids(model, truth).yaw_rad, 0.1, 1e-6);
  EXPECT_NEAR(CompareSolids(model, truth).axis_rad, 0, 1e-6);
}

TEST(CompareSolids, MeasuresRadiusHeightAndAxisOfACylinder) {
  const Solid truth = Cylinder(0.04, 0.10);
  Solid model = Cylinder(0.05, 0.08);
  Turn(&model, 0.2, Eigen::Vector3d::UnitX());
  const SolidError error = CompareSolids(model, truth);
  EXPECT_NEAR(error.extent.x(), 0.01, 1e-12);
  EXPECT_NEAR(error.extent.z(), -0.02, 1e-12);
  EXPECT_NEAR(error.axis_rad, 0.2, 1e-6);
}

TEST(VolumeIou, IsAThirdForBoxesThatShareHalfOfEach) {
  const Solid a = Box(0.1, 0.1, 0.1);
  Solid b = a;
  b.X_CO.translation().x() = 0.05;
  EXPECT_NEAR(VolumeIou(a, b), 1.0 / 3, 0.01);
}

TEST(VolumeIou, OfACylinderInABoxIsTheShareItFills) {
  EXPECT_NEAR(VolumeIou(Cylinder(0.05, 0.1), Box(0.1, 0.1, 0.1)), M_PI / 4, 0.01);
}

TEST(TiltOf, IsZeroForABoxOnAnyOfItsFaces) {
  Solid box = Box(0.1, 0.2, 0.3);
  Turn(&box, M_PI / 2, Eigen::Vector3d::UnitX());
  EXPECT_NEAR(TiltOf(box, Eigen::Vector3d::UnitZ()), 0, 1e-6);
}

TEST(TiltOf, IsARightAngleForALyingCylinder) {
  EXPECT_NEAR(TiltOf(Cylinder(0.05, 0.1), Eigen::Vector3d::UnitX()), M_PI / 2, 1e-6);
}

TEST(IsWithin, HoldsUpToTheToleranceOnly) {
  const Solid truth = Box(0.1, 0.2, 0.3);
  Solid model = truth;
  model.X_CO.translation().x() = 0.019;
  EXPECT_TRUE(IsWithin(CompareSolids(model, truth), 0.020));
  model.size.z() += 0.021;
  EXPECT_FALSE(IsWithin(CompareSolids(model, truth), 0.020));
  model = truth;
  model.X_CO.translation().x() = 0.021;
  EXPECT_FALSE(IsWithin(CompareSolids(model, truth), 0.020));
}

}  // namespace
}  // namespace declutter::accuracy
