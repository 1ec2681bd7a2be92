#include "modules/geometry/image_components.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace declutter {
namespace {

using ::testing::ElementsAre;

// The component of each pixel, -1 where not marked.
std::vector<int32_t> LabelsOf(const ComponentRuns& components, size_t num_pixels) {
  std::vector<int32_t> labels(num_pixels, -1);
  for (const ComponentRun& run : components.runs) {
    for (size_t p = run.begin; p < run.end; ++p) labels[p] = run.component;
  }
  return labels;
}

TEST(ImageComponentsTest, JoinsPixelsThatTouchAtACorner) {
  const std::vector<uint8_t> mask = {1, 0, 0, 1,  //
                                     0, 1, 0, 1,  //
                                     0, 0, 0, 0,  //
                                     1, 0, 0, 0};
  const ComponentRuns components = FindComponents(4, 4, mask, std::vector<float>(16), 0);
  EXPECT_THAT(LabelsOf(components, 16),
              ElementsAre(0, -1, -1, 1, -1, 0, -1, 1, -1, -1, -1, -1, 2, -1, -1, -1));
  EXPECT_THAT(components.num_pixels, ElementsAre(2, 2, 1));
}

TEST(ImageComponentsTest, ArmsThatMeetBelowAreOneComponent) {
  const std::vector<uint8_t> mask = {1, 0, 1, 0, 1,  //
                                     1, 0, 1, 0, 1,  //
                                     1, 1, 1, 1, 1};
  const ComponentRuns components = FindComponents(5, 3, mask, std::vector<float>(15), 0);
  EXPECT_THAT(components.num_pixels, ElementsAre(11));
}

TEST(ImageComponentsTest, AStepInTheValuesSeparates) {
  const std::vector<uint8_t> mask = {1, 1, 1, 1};
  EXPECT_THAT(LabelsOf(FindComponents(4, 1, mask, {1.0f, 1.1f, 1.3f, 1.35f}, 0.15f), 4),
              ElementsAre(0, 0, 1, 1));
}

TEST(ImageComponentsTest, AreThoseOfAFloodFill) {
  constexpr int kWidth = 23, kHeight = 17;
  std::mt19937 random(4);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<uint8_t> mask;
    std::vector<float> values;
    for (int i = 0; i < kWidth * kHeight; ++i) {
      mask.push_back(random() % 3 > 0);
      values.push_back(static_cast<float>(random() % 4));
    }
    std::vector<int32_t> expected(mask.size(), -1);
    int32_t num = 0;
    for (int seed = 0; seed < kWidth * kHeight; ++seed) {
      if (!mask[static_cast<size_t>(seed)] || expected[static_cast<size_t>(seed)] >= 0) continue;
      std::vector<int> open = {seed};
      expected[static_cast<size_t>(seed)] = num;
      while (!open.empty()) {
        const int p = open.back();
        open.pop_back();
        for (int v = std::max(p / kWidth - 1, 0); v <= std::min(p / kWidth + 1, kHeight - 1); ++v) {
          for (int u = std::max(p % kWidth - 1, 0); u <= std::min(p % kWidth + 1, kWidth - 1);
               ++u) {
            const auto q = static_cast<size_t>(v * kWidth + u);
            if (!mask[q] || expected[q] >= 0 ||
                std::abs(values[q] - values[static_cast<size_t>(p)]) > 1) {
              continue;
            }
            expected[q] = num;
            open.push_back(static_cast<int>(q));
          }
        }
      }
      ++num;
    }
    EXPECT_EQ(LabelsOf(FindComponents(kWidth, kHeight, mask, values, 1), mask.size()), expected);
  }
}

TEST(ImageComponentsTest, AnEmptyMaskHasNone) {
  const std::vector<uint8_t> mask(6);
  EXPECT_THAT(FindComponents(3, 2, mask, std::vector<float>(6), 1).num_pixels, ElementsAre());
}

}  // namespace
}  // namespace declutter
