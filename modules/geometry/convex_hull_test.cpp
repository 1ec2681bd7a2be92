#include "modules/geometry/convex_hull.h"

#include <gmock/gmock.h>

namespace declutter {
namespace {

using Eigen::Vector2d;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(ConvexHullTest, GoesCounterClockwiseAndLeavesInnerAndCollinearPointsOut) {
  EXPECT_THAT(ConvexHull({{0, 0}, {1, 1}, {0.5, 0.5}, {1, 0}, {0.5, 0}, {0, 1}, {1, 1}}),
              ElementsAre(Vector2d(0, 0), Vector2d(1, 0), Vector2d(1, 1), Vector2d(0, 1)));
}

TEST(ConvexHullTest, PointsOfALineHaveNone) {
  EXPECT_THAT(ConvexHull({{0, 0}, {1, 1}, {2, 2}, {3, 3}}), IsEmpty());
  EXPECT_THAT(ConvexHull({{1, 1}, {1, 1}, {1, 1}}), IsEmpty());
  EXPECT_THAT(ConvexHull({}), IsEmpty());
}

TEST(ConvexHullTest, SimplifyingDropsFlatCornersOnly) {
  EXPECT_THAT(SimplifyHull({{0, 0}, {0.5, -0.01}, {1, 0}, {1, 1}, {0, 1}}, 0.02),
              ElementsAre(Vector2d(0, 0), Vector2d(1, 0), Vector2d(1, 1), Vector2d(0, 1)));
  EXPECT_EQ(SimplifyHull({{0, 0}, {0.5, -0.01}, {1, 0}, {1, 1}, {0, 1}}, 0.005).size(), 5u);
}

TEST(ConvexRegionTest, MarginMovesItsBorderOutward) {
  const std::vector<Vector2d> square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_TRUE(ConvexRegion(square, 0).Contains(0.99f, 0.5f));
  EXPECT_FALSE(ConvexRegion(square, 0).Contains(1.01f, 0.5f));
  EXPECT_TRUE(ConvexRegion(square, 0.1).Contains(1.09f, 0.5f));
  EXPECT_FALSE(ConvexRegion(square, -0.1).Contains(0.95f, 0.5f));
}

TEST(ConvexRegionTest, AnEmptyHullContainsNothing) {
  EXPECT_FALSE(ConvexRegion({}, 1).Contains(0, 0));
}

}  // namespace
}  // namespace declutter
