#include "modules/model_verifier/image_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "modules/geometry/sensor_noise.h"
#include "modules/scene_renderer/scene_renderer.h"
#include "modules/scene_renderer/scene_text.h"

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

ImageNoise NoiseOf(const DepthImage& image) {
  PixelGrid every_pixel;
  every_pixel.Set(image, 1);
  return ImageNoiseMeter().Measure(every_pixel, kSupport);
}

double LevelOf(const DepthImage& image) { return NoiseOf(image).level; }

TEST(ImageNoise, HasALevelThatGrowsWithWhatNeighboursDeviateTogether) {
  EXPECT_NEAR(LevelOf(NoisyPlane(0.5, 6)), 0.5, 0.08);
  EXPECT_NEAR(LevelOf(NoisyPlane(1, 6)), 1, 0.15);
  EXPECT_NEAR(LevelOf(NoisyPlane(3, 6)), 3, 0.45);
}

TEST(ImageNoise, LeavesOutWhatLiesOnThePlane) {
  DepthImage image = NoisyPlane(1, 6);
  // 15 mm high, over a quarter of the image.
  for (size_t i = 0; i < image.counts.size() / 4; ++i) {
    image.counts[i] = static_cast<uint16_t>(image.counts[i] - 150);
  }
  EXPECT_LT(LevelOf(image), 1.6);
}

TEST(ImageNoise, HasALowLevelWhereEveryPixelDeviatesByItself) {
  EXPECT_NEAR(LevelOf(NoisyPlane(1, 1)), 1.0 / 6, 0.03);
}

TEST(ImageNoise, IsIndependentWherePixelsDeviateByThemselves) {
  EXPECT_GT(NoiseOf(NoisyPlane(1, 1)).independence, 0.95);
  // One step of five has ends in two patches.
  EXPECT_LT(NoiseOf(NoisyPlane(1, 4)).independence, 0.5);
}

double IndependenceOf(const std::string& model) {
  const RenderedScene scene = Render(ParseScene("noise { model: \"" + model + "\" }", "scene"), 1);
  PixelGrid every_pixel;
  every_pixel.Set(scene.depth, 1);
  return ImageNoiseMeter().Measure(every_pixel, scene.table).independence;
}

TEST(ImageNoise, TellsWindowsFromPixels) {
  EXPECT_LT(IndependenceOf("real_sensor"), 0.5);
  EXPECT_GT(IndependenceOf("white"), 0.95);
}

TEST(ImageNoise, HasLevelOneAndIsNotIndependentWhereNoPlaneIsSeen) {
  DepthImage image = NoisyPlane(0.5, 1);
  for (uint16_t& count : image.counts) count = static_cast<uint16_t>(count - 500);
  EXPECT_EQ(NoiseOf(image).level, 1);
  EXPECT_EQ(NoiseOf(image).independence, 0);
}

}  // namespace
}  // namespace declutter
