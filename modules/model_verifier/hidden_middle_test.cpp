#include "modules/model_verifier/hidden_middle.h"

#include <gtest/gtest.h>

namespace declutter {
namespace {

Solid SolidOf(Shape shape, const Eigen::Vector3d& size) {
  Solid solid;
  solid.shape = shape;
  solid.X_CO.translation() = Eigen::Vector3d(0.1, 0.2, 0.9);
  solid.X_CO.linear() = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  solid.size = size;
  return solid;
}

const Solid kBox = SolidOf(Shape::kBox, {0.1, 0.06, 0.08});

TEST(ProlongedOver, MovesTheEndTowardThePoints) {
  const auto longer = ProlongedOver({{0.12, 0.01, 0.04}, {0.15, -0.03, 0.041}}, kBox);
  ASSERT_TRUE(longer);
  EXPECT_TRUE(longer->size.isApprox(Eigen::Vector3d(0.2, 0.06, 0.08)));
  // The other end stays where it was.
  EXPECT_TRUE((longer->X_CO * Eigen::Vector3d(-0.1, 0, 0))
                  .isApprox(kBox.X_CO * Eigen::Vector3d(-0.05, 0, 0)));
  const auto wider = ProlongedOver({{0.02, -0.09, 0.04}}, kBox);
  ASSERT_TRUE(wider);
  EXPECT_TRUE(wider->size.isApprox(Eigen::Vector3d(0.1, 0.12, 0.08)));
  EXPECT_TRUE((wider->X_CO * Eigen::Vector3d(0, 0.06, 0))
                  .isApprox(kBox.X_CO * Eigen::Vector3d(0, 0.03, 0)));
}

TEST(ProlongedOver, NothingForPointsThatLieElsewhere) {
  EXPECT_FALSE(ProlongedOver({}, kBox));
  EXPECT_FALSE(ProlongedOver({{0.15, 0.05, 0.04}}, kBox));  // beside its prolongation
  EXPECT_FALSE(ProlongedOver({{0.15, 0, 0.06}}, kBox));     // above it
  EXPECT_FALSE(ProlongedOver({{0.05, 0, 0.04}}, kBox));     // on it
  EXPECT_FALSE(ProlongedOver({{0.36, 0, 0.04}}, kBox));     // too far away
  EXPECT_FALSE(ProlongedOver({{0.15, 0, 0.04}, {-0.15, 0, 0.04}}, kBox));
}

TEST(ProlongedOver, ForgivesAFewPoints) {
  std::vector<Eigen::Vector3d> points(10, Eigen::Vector3d(0.1, 0, 0.04));
  points.emplace_back(0.15, 0, 0.08);
  const auto longer = ProlongedOver(points, kBox);
  ASSERT_TRUE(longer);
  EXPECT_NEAR(longer->size.x(), 0.15, 1e-9);
}

TEST(CylinderThrough, ReachesFromOneFarEndToTheOther) {
  const Solid long_one = SolidOf(Shape::kCylinder, {0.08, 0.08, 0.2});
  // Pieces of it of which each axis is off a little, the second one pointing back.
  Solid a = long_one;
  a.size.z() = 0.06;
  a.X_CO =
      a.X_CO * Eigen::Translation3d(0, 0, 0.07) * Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX());
  Solid b = long_one;
  b.size = Eigen::Vector3d(0.084, 0.084, 0.04);
  b.X_CO = b.X_CO * Eigen::Translation3d(0, 0, -0.08) *
           Eigen::AngleAxisd(M_PI - 0.1, Eigen::Vector3d::UnitY());
  for (const auto& whole : {CylinderThrough(a, b), CylinderThrough(b, a)}) {
    ASSERT_TRUE(whole);
    EXPECT_NEAR(whole->height(), 0.2, 1e-9);
    EXPECT_TRUE(whole->X_CO.translation().isApprox(long_one.X_CO.translation()));
    EXPECT_NEAR(std::abs(whole->X_CO.linear().col(2).dot(long_one.X_CO.linear().col(2))), 1, 1e-9);
  }
}

TEST(CylinderThrough, NothingWhenTheyAreNotOfOne) {
  const Solid a = SolidOf(Shape::kCylinder, {0.08, 0.08, 0.06});
  const auto moved = [&](const Eigen::Vector3d& shift_O, double angle, double growth) {
    Solid b = a;
    b.X_CO =
        b.X_CO * Eigen::Translation3d(shift_O) * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX());
    b.size.head<2>().array() += growth;
    return b;
  };
  EXPECT_TRUE(CylinderThrough(a, moved({0, 0, 0.1}, 0, 0)));
  EXPECT_FALSE(CylinderThrough(a, moved({0, 0.05, 0.1}, 0, 0)));
  EXPECT_FALSE(CylinderThrough(a, moved({0, 0, 0.1}, 0.5, 0)));
  EXPECT_FALSE(CylinderThrough(a, moved({0, 0, 0.1}, 0, 0.03)));
  EXPECT_FALSE(CylinderThrough(a, moved({0, 0, 0.4}, 0, 0)));
  EXPECT_FALSE(CylinderThrough(a, a));
}

}  // namespace
}  // namespace declutter
