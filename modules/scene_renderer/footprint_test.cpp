#include "modules/scene_renderer/footprint.h"

#include <gtest/gtest.h>

#include <cmath>

namespace declutter {
namespace {

Footprint Rectangle(double x, double y, double half_x, double half_y, double yaw_rad) {
  return {false, {x, y}, {half_x, half_y}, yaw_rad};
}

Footprint Circle(double x, double y, double radius) { return {true, {x, y}, {radius, radius}, 0}; }

TEST(FootprintTest, MeasuresTheGapBetweenACornerAndAFace) {
  const Footprint upright = Rectangle(0, 0, 1, 1, 0);
  const Footprint on_its_corner = Rectangle(3, 0, 1, 1, M_PI / 4);
  EXPECT_NEAR(Gap(upright, on_its_corner), 2 - std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(Gap(on_its_corner, upright), 2 - std::sqrt(2.0), 1e-12);
}

TEST(FootprintTest, MeasuresTheGapBetweenTwoCorners) {
  EXPECT_NEAR(Gap(Rectangle(0, 0, 1, 1, 0), Rectangle(3, 3, 1, 1, 0)), std::sqrt(2.0), 1e-12);
}

TEST(FootprintTest, MeasuresTheGapBetweenACornerAndACircle) {
  EXPECT_NEAR(Gap(Rectangle(0, 0, 1, 1, 0), Circle(2, 2, 0.5)), std::sqrt(2.0) - 0.5, 1e-12);
  EXPECT_NEAR(Gap(Circle(0, 0, 1), Circle(3, 0, 0.5)), 1.5, 1e-12);
}

TEST(FootprintTest, OverlapIsNegativeEvenWhenNoCornerIsInside) {
  EXPECT_LT(Gap(Rectangle(0, 0, 2, 0.2, 0), Rectangle(0, 0, 0.2, 2, 0)), 0);
  EXPECT_LT(Gap(Rectangle(0, 0, 1, 1, 0.3), Circle(0, 0, 0.1)), 0);
}

TEST(FootprintTest, ContainsOnlyWhatLiesInsideByTheMargin) {
  const Footprint outer = Rectangle(0, 0, 1, 1, M_PI / 4);
  EXPECT_TRUE(Contains(outer, Circle(0, 0, 0.9), 0.1));
  EXPECT_FALSE(Contains(outer, Circle(0, 0, 0.9), 0.11));
  EXPECT_TRUE(Contains(Circle(0, 0, 1), Rectangle(0, 0, 0.6, 0.7, 0.2), 0.05));
  EXPECT_FALSE(Contains(Circle(0, 0, 1), Rectangle(0.2, 0, 0.6, 0.7, 0), 0));
}

}  // namespace
}  // namespace declutter
