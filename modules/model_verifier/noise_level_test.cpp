#include "modules/model_verifier/noise_level.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "modules/geometry/sensor_noise.h"

namespace declutter {
namespace {

constexpr PinholeCamera kCamera = {240, 180, 200, 200, 119.5, 89.5};
constexpr double kDistance = 0.8;  // [m]
const Plane kSupport = {-Eigen::Vector3d::UnitZ(), kDistance};

// An image of the support plane; patches of patch_px by patch_px deviate alike, by sigmas standard
// deviations of a Kinect.
DepthImage NoisyPlane(double sigmas, int patch_px) {
  std::mt19937 random(1);
  std::normal_distribution<double> unit;
  std::vector<double> deviations;
  for (int i = 0; i < kCamera.num_pixels(); ++i) deviations.push_back(unit(random));
  DepthImage image;
  image.camera = kCamera;
  image.depth_scale_m = 0.0001;
  for (int v = 0; v < kCamera.height; ++v) {
    for (int u = 0; u < kCamera.width; ++u) {
      const int patch = (v / patch_px) * kCamera.width + u / patch_px;
      const double z =
          kDistance + sigmas * MeasurementSigma(kDistance) * deviations[static_cast<size_t>(patch)];
      image.counts.push_back(static_cast<uint16_t>(std::lround(z / image.depth_scale_m)));
    }
  }
  return image;
}

double LevelOf(const DepthImage& image) {
  ObservedImage observed;
  observed.Set(image, kSupport);
  std::vector<float> buffer;
  return NoiseLevel(observed.every_pixel(), &buffer);
}

TEST(NoiseLevel, GrowsWithWhatNeighboursDeviateTogether) {
  EXPECT_NEAR(LevelOf(NoisyPlane(0.5, 6)), 0.5, 0.08);
  EXPECT_NEAR(LevelOf(NoisyPlane(1, 6)), 1, 0.15);
  EXPECT_NEAR(LevelOf(NoisyPlane(3, 6)), 3, 0.45);
}

TEST(NoiseLevel, LeavesOutWhatLiesOnThePlane) {
  DepthImage image = NoisyPlane(1, 6);
  // 15 mm high, over a quarter of the image.
  for (size_t i = 0; i < image.counts.size() / 4; ++i) {
    image.counts[i] = static_cast<uint16_t>(image.counts[i] - 150);
  }
  EXPECT_LT(LevelOf(image), 1.6);
}

TEST(NoiseLevel, IsLowWhereEveryPixelDeviatesByItself) {
  EXPECT_NEAR(LevelOf(NoisyPlane(1, 1)), 1.0 / 6, 0.03);
}

TEST(NoiseLevel, IsOneWhereNoPlaneIsSeen) {
  DepthImage image = NoisyPlane(0.5, 6);
  for (uint16_t& count : image.counts) count = static_cast<uint16_t>(count - 500);
  EXPECT_EQ(LevelOf(image), 1);
}

}  // namespace
}  // namespace declutter
