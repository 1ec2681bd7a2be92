#include "modules/feature_estimator/normals.h"

#include <gtest/gtest.h>
#include <pcl/features/normal_3d.h>
#include <pcl/point_types.h>

#include <algorithm>

#include "modules/feature_estimator/test_surfaces.h"

namespace declutter {
namespace {

constexpr double kRadius_m = 0.015;

// [rad] largest angle between the known normals of the points `select` picks and the expected one.
double LargestError(const PointImage& points, const NormalImage& normals,
                    const Eigen::Vector3d& expected,
                    const std::function<bool(const Eigen::Vector3d&)>& select) {
  double largest = -1;
  for (size_t i = 0; i < points.x.size(); ++i) {
    if (!normals.IsKnown(i) || !select({points.x[i], points.y[i], points.z[i]})) continue;
    const Eigen::Vector3d normal(normals.x[i], normals.y[i], normals.z[i]);
    largest = std::max(largest, std::acos(std::min(1.0, normal.normalized().dot(expected))));
  }
  EXPECT_GE(largest, 0) << "no known normal among the selected points";
  return largest;
}

TEST(Normals, OfAPlaneAreItsNormalTowardTheCamera) {
  const Eigen::Vector3d normal = Eigen::Vector3d(0.4, -0.5, -0.8).normalized();
  const Tabletop tabletop = Observe(PlaneSurface({0, 0, 0.8}, normal));
  const PointImage points = MakePointImage(tabletop, kRadius_m);
  const NormalImage normals = EstimateNormals(points, {kRadius_m}, 8);
  EXPECT_LT(LargestError(points, normals, normal, [](const auto&) { return true; }), 0.003);
  EXPECT_LT(*std::max_element(normals.curvature.begin(), normals.curvature.end()), 1e-4F);
}

TEST(Normals, DoNotMixSurfacesAcrossADepthJump) {
  const Eigen::Vector3d left = Eigen::Vector3d(0.5, 0, -1).normalized();
  const Eigen::Vector3d right = Eigen::Vector3d(0, -0.5, -1).normalized();
  const Surface surface =
      NearestOf(Clip(PlaneSurface({0, 0, 0.7}, left), [](const auto& p) { return p.x() < 0; }),
                PlaneSurface({0, 0, 0.8}, right));
  const Tabletop tabletop = Observe(surface);
  const PointImage points = MakePointImage(tabletop, kRadius_m);
  const NormalImage normals = EstimateNormals(points, {kRadius_m}, 8);
  EXPECT_LT(LargestError(points, normals, left, [](const auto& p) { return p.x() < 0; }), 0.003);
  EXPECT_LT(LargestError(points, normals, right, [](const auto& p) { return p.x() > 0; }), 0.003);
}

TEST(Normals, AreUnknownWithTooFewNeighbors) {
  Tabletop tabletop = Observe(PlaneSurface({0, 0, 0.8}, {0, 0, -1}));
  std::vector<uint16_t>& counts = tabletop.objects.counts;
  const uint16_t count = counts[0];
  std::fill(counts.begin(), counts.end(), uint16_t{0});
  for (const size_t pixel : {3205, 3206, 3207, 3365, 3366, 3367, 3525}) counts[pixel] = count;
  const PointImage points = MakePointImage(tabletop, kRadius_m);
  const NormalImage of_seven = EstimateNormals(points, {kRadius_m}, 7);
  const NormalImage of_eight = EstimateNormals(points, {kRadius_m}, 8);
  EXPECT_TRUE(of_seven.IsKnown(points.Index(1, 1)));
  EXPECT_FALSE(of_eight.IsKnown(points.Index(1, 1)));
}

// Read at a stride, with every other row taken from the one above.
TEST(Normals, OfStridedWindowsAreCloseToThoseOfDenseOnes) {
  const Surface surface = NearestOf(CylinderSurface({-0.02, 0, 0.75}, 0.05),
                                    PlaneSurface({0.1, 0, 0.8}, {0.6, -0.3, -0.8}));
  const PointImage points = MakePointImage(Observe(surface, 0.0005), kRadius_m);
  const NormalImage dense = EstimateNormals(points, {kRadius_m}, 8);
  const NormalImage strided = EstimateNormals(points, {kRadius_m, 5}, 8);
  std::vector<double> angles_rad;
  int num_taken = 0;
  for (int j = 1; j < points.height; ++j) {
    for (int i = 0; i < points.width; ++i) {
      const size_t p = points.Index(i, j);
      if (!dense.IsKnown(p) || !strided.IsKnown(p)) continue;
      const Eigen::Vector3f a(dense.x[p], dense.y[p], dense.z[p]);
      const Eigen::Vector3f b(strided.x[p], strided.y[p], strided.z[p]);
      angles_rad.push_back(std::asin(std::min(1.0F, a.cross(b).norm())));
      num_taken += strided.x[p] == strided.x[points.Index(i, j - 1)];
    }
  }
  std::sort(angles_rad.begin(), angles_rad.end());
  ASSERT_GT(angles_rad.size(), 15000U);
  EXPECT_LT(angles_rad[angles_rad.size() / 2], 0.015);
  EXPECT_LT(angles_rad[angles_rad.size() * 99 / 100], 0.08);
  EXPECT_GT(num_taken, 0.4 * static_cast<double>(angles_rad.size()));
  EXPECT_LT(num_taken, 0.6 * static_cast<double>(angles_rad.size()));
}

TEST(Normals, AgreeWithPclOnTheSameNeighborhoods) {
  const Surface surface = NearestOf(CylinderSurface({-0.02, 0, 0.75}, 0.05),
                                    PlaneSurface({0.1, 0, 0.8}, {0.6, -0.3, -0.8}));
  const Tabletop tabletop = Observe(surface, 0.0015);
  const PointImage points = MakePointImage(tabletop, kRadius_m);
  const NormalImage normals = EstimateNormals(points, {kRadius_m}, 3);

  auto cloud = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  std::vector<size_t> elements;
  for (size_t i = 0; i < points.x.size(); ++i) {
    if (!points.HasPoint(i)) continue;
    cloud->push_back({points.x[i], points.y[i], points.z[i]});
    elements.push_back(i);
  }
  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setInputCloud(cloud);
  estimation.setRadiusSearch(kRadius_m);
  pcl::PointCloud<pcl::Normal> expected;
  estimation.compute(expected);

  std::vector<double> angles_deg, curvature_errors;
  for (size_t i = 0; i < elements.size(); ++i) {
    const Eigen::Vector3f normal(normals.x[elements[i]], normals.y[elements[i]],
                                 normals.z[elements[i]]);
    const Eigen::Vector3f of_pcl = expected[i].getNormalVector3fMap();
    angles_deg.push_back(std::asin(std::min(1.0F, normal.cross(of_pcl).norm())) * 180 / M_PI);
    EXPECT_GT(normal.dot(of_pcl), 0);
    curvature_errors.push_back(std::abs(normals.curvature[elements[i]] - expected[i].curvature));
  }
  ASSERT_GT(elements.size(), 15000U);
  std::sort(angles_deg.begin(), angles_deg.end());
  std::sort(curvature_errors.begin(), curvature_errors.end());
  EXPECT_LT(angles_deg[angles_deg.size() / 2], 0.001);
  EXPECT_LT(angles_deg[angles_deg.size() * 99 / 100], 0.05);
  EXPECT_LT(curvature_errors[curvature_errors.size() * 99 / 100], 1e-5);
}

}  // namespace
}  // namespace declutter
