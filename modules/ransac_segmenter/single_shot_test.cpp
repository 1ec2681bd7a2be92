#include "modules/ransac_segmenter/single_shot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace declutter {
namespace {

// Half of a cylinder of radius 40 mm that looks toward -y, with 2 mm of noise.
std::vector<SideCell> NoisyArc() {
  std::mt19937 random(7);
  std::normal_distribution<float> noise(0, 0.002f);
  std::vector<SideCell> cells;
  for (float angle = -static_cast<float>(M_PI); angle < 0; angle += 0.1f) {
    for (float z = 0.01f; z < 0.08f; z += 0.016f) {
      SideCell cell;
      cell.n = {std::cos(angle), std::sin(angle)};
      cell.p = Eigen::Vector2f(noise(random), 0.7f + noise(random)) + 0.04f * cell.n;
      cell.z = z;
      cell.kappa = 20;
      cell.sigma = 0.001f;
      cell.weight = 4;
      cells.push_back(cell);
    }
  }
  return cells;
}

SideDetections Detect(SideDetector detect, const HoughSegmenterConfig& config,
                      const std::vector<SideCell>& cells, uint64_t seed) {
  SideSearch search(config);
  search.fitter.Assign(FeatureMode::kDefault, cells, seed);
  SideDetections found;
  detect(3, &search, &found);
  return found;
}

// [m] between the largest and the smallest radius that 20 seeds give.
float RangeOfRadius(SideDetector detect) {
  HoughSegmenterConfig config;
  config.set_num_samples(2);
  std::vector<float> radii;
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const SideDetections found = Detect(detect, config, NoisyArc(), seed);
    for (const Arc& arc : found.arcs) radii.push_back(arc.model.r);
  }
  EXPECT_THAT(radii, testing::SizeIs(testing::Ge(20)));
  const auto [smallest, largest] = std::minmax_element(radii.begin(), radii.end());
  return *largest - *smallest;
}

TEST(SingleShot, TakesEachFitAsADetectionWithOneVote) {
  const SideDetections found = Detect(FitSidesOnce, HoughSegmenterConfig(), NoisyArc(), 1);
  ASSERT_THAT(found.arcs, testing::SizeIs(1));
  EXPECT_THAT(found.faces, testing::IsEmpty());
  EXPECT_EQ(found.arcs[0].num_votes, 1);
  EXPECT_EQ(found.arcs[0].component, 3);
  EXPECT_NEAR(found.arcs[0].model.r, 0.04, 0.002);
}

TEST(SingleShot, DependsOnTheSeedMoreThanVotingDoes) {
  EXPECT_GT(RangeOfRadius(FitSidesOnce), 2 * RangeOfRadius(DetectSides));
}

TEST(SingleShot, FindsNothingInAnEmptyComponent) {
  const SideDetections found = Detect(FitSidesOnce, HoughSegmenterConfig(), {}, 1);
  EXPECT_THAT(found.faces, testing::IsEmpty());
  EXPECT_THAT(found.arcs, testing::IsEmpty());
}

}  // namespace
}  // namespace declutter
