#include "modules/hough_segmenter/sample_kernels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cmath>
#include <string>

namespace declutter {
namespace {

constexpr float kLimit = 0.004f;  // [m]

// On the line y = 0.5 with its normal turned by an angle.
SampleCell OnLine(float x, float angle) {
  return {x, 0.5f, std::sin(angle), -std::cos(angle), kLimit};
}

// On the circle of radius r around (0.1, 0.7), looking outward.
SampleCell OnCircle(float r, float angle) {
  const float nx = std::cos(angle), ny = std::sin(angle);
  return {0.1f + r * nx, 0.7f + r * ny, nx, ny, kLimit};
}

// Every instruction set that this processor has.
class SampleKernels : public testing::TestWithParam<int64_t> {
 protected:
  SampleKernels() {
    hwy::SetSupportedTargetsForTest(GetParam());
    hwy::GetChosenTarget().DeInit();
  }
  ~SampleKernels() override {
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().DeInit();
  }
};

std::vector<int64_t> Targets() {
  std::vector<int64_t> targets;
  for (int64_t rest = hwy::SupportedTargets(); rest != 0; rest &= rest - 1) {
    targets.push_back(rest & -rest);
  }
  return targets;
}

INSTANTIATE_TEST_SUITE_P(Targets, SampleKernels, testing::ValuesIn(Targets()),
                         [](const auto& target) {
                           return std::string(hwy::TargetName(target.param));
                         });

TEST_P(SampleKernels, LinesThroughPairsThatAgreeInTheirOrder) {
  SamplePairs pairs;
  for (int k = 0; k < 70; ++k) {  // more than there is room for at first
    const float x = 0.01f * static_cast<float>(k);
    // In every third pair one of the cells looks another way.
    pairs.Add(OnLine(x, 0.1f), OnLine(x + 0.02f, k % 3 == 1 ? 0.6f : -0.1f));
    pairs.Add(OnLine(x + 0.02f, k % 3 == 2 ? 0.6f : 0), OnLine(x, 0));
  }
  std::vector<LineShape> lines;
  LinesThrough(pairs, std::cos(0.44f), &lines);
  ASSERT_EQ(lines.size(), 140u - 23u - 23u);
  for (const LineShape& line : lines) {
    EXPECT_NEAR(line.nx, 0, 1e-5f);
    EXPECT_NEAR(line.ny, -1, 1e-5f);  // on the side of the normals whichever cell is first
    EXPECT_NEAR(line.rho, -0.5f, 1e-5f);
  }
}

TEST_P(SampleKernels, CirclesAroundWhereNormalsMeet) {
  SamplePairs pairs;
  const auto add_on_circle = [&pairs](float r) { pairs.Add(OnCircle(r, -2), OnCircle(r, -1)); };
  add_on_circle(0.03f);
  add_on_circle(0.01f);  // too small
  add_on_circle(0.05f);
  add_on_circle(0.2f);                                  // too large
  pairs.Add(OnLine(0, 0), OnLine(0.03f, 0.01f));        // almost parallel
  pairs.Add(OnLine(0, 0.3f), OnLine(0.03f, -0.3f));     // meet outside
  pairs.Add(OnCircle(0.03f, -2), OnCircle(0.05f, -1));  // each 10 mm off the circle between them
  add_on_circle(0.04f);
  std::vector<CircleShape> circles;
  CirclesThrough(pairs, {0.015f, 0.12f}, &circles);
  std::vector<float> radii;
  for (const CircleShape& circle : circles) {
    EXPECT_NEAR(circle.cx, 0.1f, 1e-5f);
    EXPECT_NEAR(circle.cy, 0.7f, 1e-5f);
    radii.push_back(circle.r);
  }
  EXPECT_THAT(radii, testing::ElementsAre(testing::FloatNear(0.03f, 1e-5f),
                                          testing::FloatNear(0.05f, 1e-5f),
                                          testing::FloatNear(0.04f, 1e-5f)));
}

TEST_P(SampleKernels, NothingThroughNoPairs) {
  std::vector<LineShape> lines(3);
  LinesThrough(SamplePairs(), 0.9f, &lines);
  EXPECT_THAT(lines, testing::IsEmpty());
}

}  // namespace
}  // namespace declutter
