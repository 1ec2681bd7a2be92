#include "modules/geometry/edge_direction.h"

#include <gtest/gtest.h>

#include <cmath>

namespace declutter {
namespace {

constexpr float kDegree = static_cast<float>(M_PI / 180);

void AddLine(const Eigen::Vector2f& from, const Eigen::Vector2f& to, int num,
             std::vector<Eigen::Vector2f>* edge) {
  for (int i = 0; i < num; ++i) {
    edge->push_back(from + static_cast<float>(i) / static_cast<float>(num) * (to - from));
  }
}

// [rad] between a direction and the nearest of the sides of a rectangle turned by `angle`.
float AngleToSides(const Eigen::Vector2f& direction, float angle) {
  const float quarter = static_cast<float>(M_PI / 2);
  return std::abs(std::remainder(std::atan2(direction.y(), direction.x()) - angle, quarter));
}

TEST(EdgeDirection, IsThatOfTheSidesWhereAnOccluderHidesHalfOfARectangle) {
  // The smallest rectangle around this corner of a box, cut off aslant, lies along the cut.
  const float angle = 25 * kDegree;
  const Eigen::Vector2f x(std::cos(angle), std::sin(angle)), y(-x.y(), x.x());
  const Eigen::Vector2f corner(0.1f, 0.7f);
  std::vector<Eigen::Vector2f> edge;
  AddLine(corner, corner + 0.20f * x, 100, &edge);
  AddLine(corner, corner + 0.15f * y, 75, &edge);
  const auto direction = EdgeDirection(edge);
  ASSERT_TRUE(direction);
  EXPECT_LT(AngleToSides(*direction, angle), 1.5f * kDegree);
}

TEST(EdgeDirection, IsThatOfTwoParallelSides) {
  const float angle = 70 * kDegree;
  const Eigen::Vector2f x(std::cos(angle), std::sin(angle)), y(-x.y(), x.x());
  std::vector<Eigen::Vector2f> edge;
  AddLine({0, 0}, 0.06f * x, 30, &edge);
  AddLine(0.04f * y, 0.04f * y + 0.05f * x, 25, &edge);
  const auto direction = EdgeDirection(edge);
  ASSERT_TRUE(direction);
  EXPECT_LT(AngleToSides(*direction, angle), 3 * kDegree);
}

TEST(EdgeDirection, IsUnknownForFewPoints) {
  std::vector<Eigen::Vector2f> edge;
  AddLine({0, 0}, {0.1f, 0}, 10, &edge);
  EXPECT_FALSE(EdgeDirection(edge));
}

}  // namespace
}  // namespace declutter
