#include "modules/feature_estimator/feature_estimator.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "modules/feature_estimator/test_surfaces.h"

namespace declutter {
namespace {

// A can 60 mm in radius before a wall.
Tabletop CanBeforeWall() {
  Tabletop tabletop = Observe(
      NearestOf(CylinderSurface({0, 0, 0.75}, 0.060), PlaneSurface({0, 0, 1}, {0, 0, -1})), 0.0005);
  tabletop.header = {123, "scene", ""};
  return tabletop;
}

FeatureEstimatorConfig Config(const std::string& mode) {
  FeatureEstimatorConfig config;
  config.set_mode(mode);
  return config;
}

const FeaturePoint& PointAt(const FeatureCloud& cloud, int u, int v) {
  return *std::find_if(cloud.points.begin(), cloud.points.end(), [&](const FeaturePoint& point) {
    return point.pixel == v * cloud.width + u;
  });
}

bool operator==(const FeaturePoint& a, const FeaturePoint& b) {
  return a.pixel == b.pixel && a.normal == b.normal && a.kappa == b.kappa &&
         a.curvature == b.curvature && a.r_min == b.r_min && a.component == b.component;
}

TEST(FeatureEstimator, GivesHorizontalCurvatureInModeDefault) {
  const FeatureCloud cloud = FeatureEstimator(Config("default")).Estimate(CanBeforeWall());
  EXPECT_EQ(cloud.mode, FeatureMode::kDefault);
  EXPECT_NEAR(PointAt(cloud, 80, 60).kappa, 1 / 0.060, 2.5);
  EXPECT_NEAR(PointAt(cloud, 10, 60).kappa, 0, 1);
  EXPECT_EQ(PointAt(cloud, 80, 60).r_min, 0);
  EXPECT_NEAR(PointAt(cloud, 80, 60).normal.z(), -1, 0.01);
}

TEST(FeatureEstimator, GivesMinimumRadiusInModePaper) {
  const FeatureCloud cloud = FeatureEstimator(Config("paper")).Estimate(CanBeforeWall());
  EXPECT_EQ(cloud.mode, FeatureMode::kPaper);
  EXPECT_NEAR(PointAt(cloud, 80, 60).r_min, 0.060, 0.015);
  EXPECT_GT(PointAt(cloud, 10, 60).r_min, 0.15);
  EXPECT_EQ(PointAt(cloud, 80, 60).kappa, 0);
  EXPECT_GT(PointAt(cloud, 80, 60).curvature, 10 * PointAt(cloud, 10, 60).curvature);
}

TEST(FeatureEstimator, KeepsTheHeaderAndTheOrderOfPixels) {
  const Tabletop tabletop = CanBeforeWall();
  const FeatureCloud cloud = FeatureEstimator(Config("default")).Estimate(tabletop);
  EXPECT_EQ(cloud.header.utime, 123);
  EXPECT_EQ(cloud.header.frame, "scene");
  EXPECT_EQ(cloud.width, 160);
  EXPECT_EQ(cloud.height, 120);
  EXPECT_EQ(cloud.points.size(), tabletop.objects.counts.size());
  for (size_t i = 0; i < cloud.points.size(); ++i) {
    ASSERT_EQ(cloud.points[i].pixel, static_cast<int>(i));
  }
}

TEST(FeatureEstimator, SeparatesTheCanFromTheWallOnItsSides) {
  const FeatureCloud cloud = FeatureEstimator(Config("default")).Estimate(CanBeforeWall());
  EXPECT_EQ(cloud.num_components, 3);
  EXPECT_EQ(PointAt(cloud, 10, 60).component, 0);
  EXPECT_EQ(PointAt(cloud, 80, 60).component, 1);
  EXPECT_EQ(PointAt(cloud, 150, 60).component, 2);
}

TEST(FeatureEstimator, LeavesOutPointsWithoutAComponent) {
  Tabletop tabletop = CanBeforeWall();
  std::fill(tabletop.objects.counts.begin() + 1, tabletop.objects.counts.begin() + 1600, 0);
  const FeatureCloud cloud = FeatureEstimator(Config("default")).Estimate(tabletop);
  EXPECT_EQ(cloud.points.size(), 110U * 160U);
  EXPECT_EQ(cloud.points.front().pixel, 1600);
}

TEST(FeatureEstimator, FindsTheSameSurfacesInAThinnedImage) {
  Tabletop tabletop = CanBeforeWall();
  tabletop.thinning = 2;
  const FeatureCloud cloud = FeatureEstimator(Config("default")).Estimate(tabletop);
  EXPECT_EQ(cloud.points.size(), 80U * 60U);
  EXPECT_EQ(cloud.num_components, 3);
  EXPECT_NEAR(PointAt(cloud, 80, 60).kappa, 1 / 0.060, 2.5);
  EXPECT_EQ(PointAt(cloud, 150, 118).component, 2);
}

TEST(FeatureEstimator, OfAnEmptyTabletopIsEmpty) {
  Tabletop tabletop = CanBeforeWall();
  std::fill(tabletop.objects.counts.begin(), tabletop.objects.counts.end(), uint16_t{0});
  for (const char* mode : {"default", "paper"}) {
    EXPECT_TRUE(FeatureEstimator(Config(mode)).Estimate(tabletop).points.empty());
    EXPECT_TRUE(FeatureEstimator(Config(mode)).Estimate(Tabletop()).points.empty());
  }
}

TEST(FeatureEstimator, GivesTheSameOutputForTheSameInput) {
  for (const char* mode : {"default", "paper"}) {
    const FeatureCloud first = FeatureEstimator(Config(mode)).Estimate(CanBeforeWall());
    const FeatureCloud second = FeatureEstimator(Config(mode)).Estimate(CanBeforeWall());
    EXPECT_TRUE(std::equal(first.points.begin(), first.points.end(), second.points.begin(),
                           second.points.end(),
                           [](const auto& a, const auto& b) { return a == b; }));
  }
}

}  // namespace
}  // namespace declutter
