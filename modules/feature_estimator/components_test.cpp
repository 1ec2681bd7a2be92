#include "modules/feature_estimator/components.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>

#include <algorithm>
#include <set>

#include "modules/feature_estimator/test_surfaces.h"

namespace declutter {
namespace {

using ::testing::SizeIs;

constexpr Connection kConnection{0.010, 0, 6};

// Two walls that face the camera, the right one further away.
Tabletop TwoWalls(double step_m) {
  const auto is_left = [](const Eigen::Vector3d& p) { return p.x() < 0; };
  return Observe(NearestOf(Clip(PlaneSurface({0, 0, 0.8}, {0, 0, -1}), is_left),
                           PlaneSurface({0, 0, 0.8 + step_m}, {0, 0, -1})));
}

int CountComponents(const Tabletop& tabletop, const Connection& connection, int min_points = 50) {
  return FindComponents(MakePointImage(tabletop, 0.01, 6), connection, min_points).num_components;
}

int32_t ComponentAt(const Components& components, size_t element) {
  for (const PointRun& run : components.runs) {
    if (run.begin <= element && element < run.end) return run.component;
  }
  return -1;
}

void ClearColumns(int first, int last, Tabletop* tabletop) {
  DepthImage& image = tabletop->objects;
  for (int v = 0; v < image.camera.height; ++v) {
    for (int u = first; u <= last; ++u) {
      image.counts[static_cast<size_t>(v * image.camera.width + u)] = 0;
    }
  }
}

TEST(Components, JoinAcrossSmallDepthStepsOnly) {
  EXPECT_EQ(CountComponents(TwoWalls(0.008), kConnection), 1);
  EXPECT_EQ(CountComponents(TwoWalls(0.012), kConnection), 2);
}

TEST(Components, JoinAcrossWiderStepsWhereDepthIsNoisier) {
  EXPECT_EQ(CountComponents(TwoWalls(0.012), {0.010, 0.025, 6}), 1);
}

TEST(Components, JoinAcrossMissingPixelsWithinReach) {
  Tabletop tabletop = TwoWalls(0);
  ClearColumns(70, 74, &tabletop);
  EXPECT_EQ(CountComponents(tabletop, kConnection), 1);
  EXPECT_EQ(CountComponents(tabletop, {0.010, 0, 5}), 2);
}

TEST(Components, WithTooFewPointsAreDropped) {
  Tabletop tabletop = TwoWalls(0.1);
  ClearColumns(1, 79, &tabletop);
  EXPECT_EQ(CountComponents(tabletop, kConnection, 120), 2);
  EXPECT_EQ(CountComponents(tabletop, kConnection, 121), 1);
}

TEST(Components, AreNumberedInTheOrderOfTheirFirstPixels) {
  const PointImage points = MakePointImage(TwoWalls(0.1), 0.01, 6);
  const Components components = FindComponents(points, kConnection, 50);
  EXPECT_EQ(ComponentAt(components, points.Index(0, 119)), 0);
  EXPECT_EQ(ComponentAt(components, points.Index(159, 0)), 1);
}

// Random holes, a depth step and noise: chains of points decide.
TEST(Components, AreTheEuclideanClustersOfPcl) {
  Tabletop tabletop = TwoWalls(0.04);
  std::mt19937 generator(3);
  for (uint16_t& count : tabletop.objects.counts) {
    if (generator() % 100 < 93) count = 0;
    count = static_cast<uint16_t>(count == 0 ? 0 : count + generator() % 200);
  }
  const PointImage points = MakePointImage(tabletop, 0.01, 6);
  const Components components = FindComponents(points, {0.008, 0, 6}, 1);

  auto cloud = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  std::vector<std::set<int>> ours(static_cast<size_t>(components.num_components));
  for (const PointRun& run : components.runs) {
    for (size_t i = run.begin; i < run.end; ++i) {
      ours[static_cast<size_t>(run.component)].insert(static_cast<int>(cloud->size()));
      cloud->push_back({points.x[i], points.y[i], points.z[i]});
    }
  }
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setInputCloud(cloud);
  extraction.setSearchMethod(std::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
  extraction.setClusterTolerance(0.008);
  std::vector<pcl::PointIndices> clusters;
  extraction.extract(clusters);

  std::vector<std::set<int>> expected;
  for (const auto& cluster : clusters) {
    expected.emplace_back(cluster.indices.begin(), cluster.indices.end());
  }
  std::sort(expected.begin(), expected.end());
  std::sort(ours.begin(), ours.end());
  ASSERT_GT(expected.size(), 10U);
  EXPECT_EQ(ours, expected);
}

}  // namespace
}  // namespace declutter
