#include "modules/plane_filter/plane_samples.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace declutter {
namespace {

constexpr InversePlane kPlane{0.2f, -0.4f, 1.1f};

// A grid in one plane with a measurement at every gap-th pixel.
InverseDepth Grid(int gap) {
  InverseDepth grid;
  grid.width = 40;
  grid.height = 30;
  for (int u = 0; u < grid.width; ++u) grid.ray_x.push_back(0.02f * static_cast<float>(u) - 0.4f);
  for (int v = 0; v < grid.height; ++v) grid.ray_y.push_back(0.02f * static_cast<float>(v) - 0.3f);
  for (const float y : grid.ray_y) {
    for (const float x : grid.ray_x) {
      const bool is_measured = grid.values.size() % static_cast<size_t>(gap) == 0;
      grid.values.push_back(is_measured ? kPlane.At(x, y) : 0);
    }
  }
  return grid;
}

TEST(PlaneSamplesTest, GoThroughPixelsWithAMeasurementOnly) {
  for (const int gap : {1, 3, 7}) {
    const InverseDepth grid = Grid(gap);
    RandomIndex random(3);
    PlaneSamples samples(grid, 100000, &random);
    for (int i = 0; i < 100; ++i) {
      const auto plane = samples.Next();
      ASSERT_TRUE(plane) << gap;
      EXPECT_NEAR(plane->a, kPlane.a, 1e-3);
      EXPECT_NEAR(plane->b, kPlane.b, 1e-3);
      EXPECT_NEAR(plane->c, kPlane.c, 1e-3);
    }
  }
}

TEST(PlaneSamplesTest, EndAfterTheirDraws) {
  const InverseDepth grid = Grid(2);
  int num_before = 0;
  for (const int max_draws : {1, 255, 1000, 5000}) {
    RandomIndex random(3);
    PlaneSamples samples(grid, max_draws, &random);
    int num = 0;
    while (samples.Next()) ++num;
    EXPECT_LE(num, max_draws / 2);
    EXPECT_GE(num, num_before);
    EXPECT_FALSE(samples.Next());
    num_before = num;
  }
  EXPECT_GT(num_before, 0);
}

TEST(PlaneSamplesTest, LeaveTheGeneratorBehindWhatTheyDrew) {
  InverseDepth grid = Grid(1);
  std::fill(grid.values.begin(), grid.values.end(), 0.0f);
  RandomIndex random(3), expected(3);
  EXPECT_FALSE(PlaneSamples(grid, 1000, &random).Next());
  // Of each draw only the pixel that it began with.
  expected.Skip(2000);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(random(1000), expected(1000));
}

}  // namespace
}  // namespace declutter
