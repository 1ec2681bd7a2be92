#include "modules/hough_segmenter/height_bands.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace declutter {
namespace {

constexpr float kSigma = 0.001f;  // [m]

// Heights of faces, num of each, with noise.
std::vector<float> Noisy(const std::vector<float>& faces, int num) {
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0, kSigma);
  std::vector<float> heights;
  for (const float face : faces) {
    for (int i = 0; i < num; ++i) heights.push_back(face + noise(random));
  }
  return heights;
}

TEST(LimitsBetweenFaces, PartsFacesThatAreSixSigmaApart) {
  HeightBands bands;
  const std::vector<float>& limits =
      bands.LimitsBetweenFaces(Noisy({0.050f, 0.056f, 0.062f}, 500), kSigma, 60);
  EXPECT_THAT(limits, testing::ElementsAre(testing::FloatNear(0.053f, 0.001f),
                                           testing::FloatNear(0.059f, 0.001f)));
}

TEST(LimitsBetweenFaces, LeavesOneFaceWhole) {
  EXPECT_THAT(HeightBands().LimitsBetweenFaces(Noisy({0.05f}, 2000), kSigma, 60),
              testing::IsEmpty());
}

TEST(LimitsBetweenFaces, LeavesHeightsThatFewHaveWithTheirNeighbours) {
  std::vector<float> heights = Noisy({0.05f}, 500);
  heights.insert(heights.end(), 20, 0.06f);
  EXPECT_THAT(HeightBands().LimitsBetweenFaces(heights, kSigma, 60), testing::IsEmpty());
}

TEST(SplitAtHeights, PartsTwoFacesAcrossAStepThatNoiseBridges) {
  // Columns 0 to 19 at 50 mm, the others at 55 mm, one pixel in between on its way.
  constexpr int kColumns = 40;
  constexpr int kRows = 20;
  std::vector<float> heights(kColumns * kRows, 0.05f);
  for (size_t i = 0; i < heights.size(); ++i) {
    if (i % kColumns >= 20) heights[i] = 0.055f;
  }
  heights[10 * kColumns + 20] = 0.0525f;
  const std::vector<uint8_t> mask(heights.size(), 1);
  const std::vector<int32_t> labels(heights.size(), 0);
  ComponentRuns patches = FindComponents(kColumns, kRows, mask, heights, 0.006f);
  ASSERT_EQ(patches.num_pixels.size(), 1u);
  ASSERT_TRUE(HeightBands().Split(kColumns, kRows, mask, heights, 0.006f, 60, labels, &patches));
  ASSERT_EQ(patches.num_pixels.size(), 2u);
  // The boundary may be off by a column.
  EXPECT_NEAR(patches.num_pixels[0], 400, kRows);
  EXPECT_NEAR(patches.num_pixels[1], 400, kRows);
}

}  // namespace
}  // namespace declutter
