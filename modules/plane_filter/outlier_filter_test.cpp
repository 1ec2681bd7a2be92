#include "modules/plane_filter/outlier_filter.h"

#include <gtest/gtest.h>
#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cmath>
#include <random>

namespace declutter {
namespace {

constexpr int kWidth = 120;
constexpr int kHeight = 90;

// A face at 0.8 m with a step to 0.9 m in the middle and 1 mm of noise.
DepthImage Step() {
  DepthImage image;
  image.camera = {kWidth, kHeight, 525, 525, 59.5, 44.5};
  image.depth_scale_m = 0.0001;
  std::mt19937 random(1);
  for (int i = 0; i < kWidth * kHeight; ++i) {
    const int noise = static_cast<int>(random() % 21) - 10;
    image.counts.push_back(static_cast<uint16_t>((i % kWidth < 60 ? 8000 : 9000) + noise));
  }
  return image;
}

// Moves every 97th pixel 20 to 60 mm toward the camera and returns which.
PixelMask AddFlyingPixels(DepthImage* image) {
  PixelMask flying(image->counts.size());
  for (size_t i = 50; i < flying.size(); i += 97) {
    flying[i] = 1;
    image->counts[i] = static_cast<uint16_t>(image->counts[i] - 200 - 4 * (i % 101));
  }
  return flying;
}

PixelMask RemoveOutliersOf(const DepthImage& image, const PlaneFilterConfig& config) {
  return OutlierFilter(config).Filter(Invert(image), PixelMask(image.counts.size(), 1));
}

TEST(OutlierFilterTest, DropsFlyingPixels) {
  DepthImage image = Step();
  const PixelMask flying = AddFlyingPixels(&image);
  const PixelMask kept = RemoveOutliersOf(image, PlaneFilterConfig());
  for (size_t i = 0; i < kept.size(); ++i) EXPECT_FALSE(flying[i] && kept[i]) << i;
}

TEST(OutlierFilterTest, KeepsThePixelsOnBothSidesOfAnEdge) {
  const PixelMask kept = RemoveOutliersOf(Step(), PlaneFilterConfig());
  int num_dropped = 0;
  for (int v = 3; v < kHeight - 3; ++v) {
    for (int u = 3; u < kWidth - 3; ++u) num_dropped += !kept[static_cast<size_t>(v * kWidth + u)];
  }
  EXPECT_EQ(num_dropped, 0);
}

TEST(OutlierFilterTest, DropsPixelsThatAreAlone) {
  const DepthImage image = Step();
  PixelMask mask(image.counts.size());
  for (int v = 20; v < 40; ++v) {
    for (int u = 20; u < 40; ++u) mask[static_cast<size_t>(v * kWidth + u)] = 1;
  }
  mask[60 * kWidth + 90] = 1;
  const PixelMask kept = OutlierFilter(PlaneFilterConfig()).Filter(Invert(image), mask);
  EXPECT_EQ(std::count(kept.begin(), kept.end(), 1), 400);
  EXPECT_FALSE(kept[60 * kWidth + 90]);
}

TEST(OutlierFilterTest, AnEmptyMaskStaysEmpty) {
  const DepthImage image = Step();
  const PixelMask kept =
      OutlierFilter(PlaneFilterConfig()).Filter(Invert(image), PixelMask(image.counts.size()));
  EXPECT_EQ(std::count(kept.begin(), kept.end(), 1), 0);
}

TEST(OutlierFilterTest, AgreesWithThePointCloudLibrary) {
  DepthImage image = Step();
  AddFlyingPixels(&image);
  PlaneFilterConfig config;
  const PixelMask kept = RemoveOutliersOf(image, config);

  const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const Eigen::Vector3f p = image.PointAt(u, v).cast<float>();
      cloud->push_back({p.x(), p.y(), p.z()});
    }
  }
  pcl::StatisticalOutlierRemoval<pcl::PointXYZ> oracle;
  oracle.setInputCloud(cloud);
  oracle.setMeanK(config.outlier_neighbors());
  // Its standard deviation includes the outliers, ours does not: it takes a smaller factor.
  oracle.setStddevMulThresh(1);
  std::vector<int> oracle_kept;
  oracle.filter(oracle_kept);
  PixelMask expected(kept.size());
  for (const int i : oracle_kept) expected[static_cast<size_t>(i)] = 1;

  EXPECT_LT(oracle_kept.size(), kept.size() - 100);
  int num_different = 0;
  for (size_t i = 0; i < kept.size(); ++i) num_different += kept[i] != expected[i];
  EXPECT_LT(num_different, static_cast<int>(kept.size()) / 1000);
}

}  // namespace
}  // namespace declutter
