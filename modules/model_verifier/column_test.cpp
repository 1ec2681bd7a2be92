#include "modules/model_verifier/column.h"

#include <gtest/gtest.h>

namespace declutter {
namespace {

// A box on a table below the camera at the origin, its centre at (x, y, z) of C, turned by yaw
// about the line of sight.
Solid BoxAt(const Eigen::Vector3d& centre, const Eigen::Vector3d& size, double yaw = 0) {
  Solid box;
  box.X_CO = Eigen::Translation3d(centre) * Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()) *
             Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ());
  box.size = size;
  return box;
}

// Seen from its sides toward -x and -y of C.
const Solid kLower = BoxAt({0.3, 0.4, 0.95}, {0.12, 0.08, 0.1});

TEST(AreFlush, WhenTheSidesTowardTheCameraLieInOnePlane) {
  // Narrower at its hidden sides only.
  const Solid upper = BoxAt({0.29, 0.39, 0.85}, {0.1, 0.06, 0.1});
  EXPECT_TRUE(AreFlush(kLower, upper));
  EXPECT_TRUE(AreFlush(upper, kLower));
  EXPECT_FALSE(HaveOneCrossSection(kLower, upper));
}

TEST(AreFlush, WhenTheirAxesChangePlaces) {
  EXPECT_TRUE(AreFlush(kLower, BoxAt({0.29, 0.39, 0.85}, {0.06, 0.1, 0.1}, 0.5 * M_PI)));
}

TEST(AreFlush, NotWhenOneSideStandsBack) {
  EXPECT_FALSE(AreFlush(kLower, BoxAt({0.305, 0.39, 0.85}, {0.1, 0.06, 0.1})));
  EXPECT_FALSE(AreFlush(kLower, BoxAt({0.29, 0.405, 0.85}, {0.1, 0.06, 0.1})));
}

TEST(AreFlush, NotWhenOneIsTurned) {
  EXPECT_FALSE(AreFlush(kLower, BoxAt({0.3, 0.4, 0.85}, {0.12, 0.08, 0.1}, 0.2)));
}

TEST(AreFlush, NotOfCylinders) {
  Solid cylinder = kLower;
  cylinder.shape = Shape::kCylinder;
  EXPECT_FALSE(AreFlush(cylinder, cylinder));
}

TEST(HaveOneCrossSection, ForgivesBlurredEdges) {
  EXPECT_TRUE(HaveOneCrossSection(kLower, BoxAt({0.303, 0.4, 0.85}, {0.125, 0.075, 0.1})));
  EXPECT_TRUE(HaveOneCrossSection(kLower, BoxAt({0.303, 0.4, 0.85}, {0.075, 0.125, 0.1}, M_PI_2)));
  EXPECT_FALSE(HaveOneCrossSection(kLower, BoxAt({0.3, 0.4, 0.85}, {0.135, 0.075, 0.1})));
  EXPECT_FALSE(HaveOneCrossSection(kLower, BoxAt({0.311, 0.4, 0.85}, {0.12, 0.08, 0.1})));
}

TEST(HaveOneCrossSection, NotWhenOneIsTurned) {
  EXPECT_FALSE(HaveOneCrossSection(kLower, BoxAt({0.3, 0.4, 0.85}, {0.12, 0.08, 0.1}, M_PI_2)));
  EXPECT_FALSE(HaveOneCrossSection(kLower, BoxAt({0.3, 0.4, 0.85}, {0.12, 0.08, 0.1}, 0.2)));
  Solid cylinder = kLower;
  cylinder.shape = Shape::kCylinder;
  cylinder.size.y() = cylinder.size.x();
  Solid turned = cylinder;
  turned.X_CO = turned.X_CO * Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ());
  EXPECT_TRUE(HaveOneCrossSection(cylinder, turned));
}

TEST(IsTopSeen, ByPointsInsideItsEdges) {
  const Solid box = BoxAt({0, 0, 0.9}, {0.1, 0.1, 0.06});
  std::vector<Eigen::Vector3d> points(14, Eigen::Vector3d(0.02, 0.03, 0.029));
  EXPECT_FALSE(IsTopSeen(box, points, 4));
  points.emplace_back(0, 0, 0.031);
  EXPECT_TRUE(IsTopSeen(box, points, 4));
  EXPECT_FALSE(IsTopSeen(box, points, 1));

  const std::vector<Eigen::Vector3d> corner(100, Eigen::Vector3d(0.035, 0.035, 0.03));
  EXPECT_TRUE(IsTopSeen(box, corner, 1));
  Solid cylinder = box;
  cylinder.shape = Shape::kCylinder;
  EXPECT_FALSE(IsTopSeen(cylinder, corner, 1));

  const std::vector<Eigen::Vector3d> side(100, Eigen::Vector3d(0.05, 0, 0.03));
  EXPECT_FALSE(IsTopSeen(box, side, 1));
}

}  // namespace
}  // namespace declutter
