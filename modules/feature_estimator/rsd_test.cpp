#include "modules/feature_estimator/rsd.h"

#include <gtest/gtest.h>
#include <pcl/features/rsd.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

#include <algorithm>

#include "modules/feature_estimator/test_surfaces.h"

namespace declutter {
namespace {

constexpr double kRadius_m = 0.020;
constexpr double kPlaneRadius_m = 0.2;
constexpr int kNumBins = 5;

// r_min of the point seen by the pixel in the middle.
float MinimumRadiusInTheMiddle(const Tabletop& tabletop) {
  const PointImage points = MakePointImage(tabletop, kRadius_m);
  const NormalImage normals = EstimateNormals(points, {kRadius_m}, 8);
  const std::vector<float> r_min =
      EstimateMinimumRadius(points, normals, {kRadius_m, kNumBins, kPlaneRadius_m}).r_min;
  return r_min[points.Index(points.width / 2, points.height / 2)];
}

TEST(MinimumRadius, OfACylinderIsNearItsRadius) {
  EXPECT_NEAR(MinimumRadiusInTheMiddle(Observe(CylinderSurface({0, 0, 0.8}, 0.040))), 0.040, 0.008);
  EXPECT_NEAR(MinimumRadiusInTheMiddle(Observe(CylinderSurface({0, 0, 0.8}, 0.080))), 0.080, 0.016);
}

TEST(MinimumRadius, OfAPlaneIsThePlaneRadius) {
  EXPECT_NEAR(MinimumRadiusInTheMiddle(Observe(PlaneSurface({0, 0, 0.8}, {0, 0, -1}))),
              0.9 * kPlaneRadius_m, 1e-6);
}

TEST(MinimumRadius, AgreesWithPclOnTheSameNormals) {
  const Surface surface = NearestOf(CylinderSurface({-0.02, 0, 0.75}, 0.05),
                                    PlaneSurface({0.1, 0, 0.8}, {0.6, -0.3, -0.8}));
  const PointImage points = MakePointImage(Observe(surface, 0.0015), kRadius_m);
  const NormalImage normals = EstimateNormals(points, {kRadius_m}, 8);
  const std::vector<float> r_min =
      EstimateMinimumRadius(points, normals, {kRadius_m, kNumBins, kPlaneRadius_m}).r_min;

  auto cloud = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  auto cloud_normals = std::make_shared<pcl::PointCloud<pcl::Normal>>();
  std::vector<size_t> elements;
  for (size_t i = 0; i < points.x.size(); ++i) {
    if (!normals.IsKnown(i)) continue;
    cloud->push_back({points.x[i], points.y[i], points.z[i]});
    cloud_normals->push_back({normals.x[i], normals.y[i], normals.z[i]});
    elements.push_back(i);
  }
  pcl::RSDEstimation<pcl::PointXYZ, pcl::Normal, pcl::PrincipalRadiiRSD> estimation;
  estimation.setInputCloud(cloud);
  estimation.setInputNormals(cloud_normals);
  // Sorted, so that the angles are those to the normal of the point itself.
  estimation.setSearchMethod(std::make_shared<pcl::search::KdTree<pcl::PointXYZ>>(true));
  estimation.setRadiusSearch(kRadius_m);
  estimation.setPlaneRadius(kPlaneRadius_m);
  pcl::PointCloud<pcl::PrincipalRadiiRSD> expected;
  estimation.compute(expected);

  std::vector<double> errors_m;
  for (size_t i = 0; i < elements.size(); ++i) {
    errors_m.push_back(std::abs(r_min[elements[i]] - expected[i].r_min));
  }
  ASSERT_GT(errors_m.size(), 15000U);
  std::sort(errors_m.begin(), errors_m.end());
  EXPECT_LT(errors_m[errors_m.size() / 2], 1e-6);
  EXPECT_LT(errors_m[errors_m.size() * 99 / 100], 1e-4);
}

}  // namespace
}  // namespace declutter
