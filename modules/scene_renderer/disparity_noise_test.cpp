#include "modules/scene_renderer/disparity_noise.h"

#include <gtest/gtest.h>

#include <cmath>

namespace declutter {
namespace {

constexpr int kWidth = 640, kHeight = 480;

double Product(const std::vector<float>& field, int du, int dv) {
  double sum = 0;
  for (int v = 0; v + dv < kHeight; ++v) {
    for (int u = 0; u + du < kWidth; ++u) {
      sum += static_cast<double>(field[static_cast<size_t>(v * kWidth + u)]) *
             static_cast<double>(field[static_cast<size_t>((v + dv) * kWidth + u + du)]);
    }
  }
  return sum / ((kWidth - du) * (kHeight - dv));
}

TEST(DisparityNoiseTest, BoxNoiseIsCorrelatedAcrossItsBoxAndNoFurther) {
  const std::vector<float> noise = BoxNoise(kWidth, kHeight, 9, 4, 1);
  EXPECT_NEAR(Product(noise, 0, 0), 1, 0.03);
  EXPECT_NEAR(Product(noise, 3, 0), 6.0 / 9, 0.03);
  EXPECT_NEAR(Product(noise, 0, 1), 3.0 / 4, 0.03);
  EXPECT_NEAR(Product(noise, 9, 0), 0, 0.03);
  EXPECT_NEAR(Product(noise, 0, 4), 0, 0.03);
}

TEST(DisparityNoiseTest, SmoothFieldHasUnitRmsAndNoTilt) {
  const std::vector<float> field = SmoothField(kWidth, kHeight, 72, 1);
  double mean = 0, tilt_u = 0, tilt_v = 0;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const double value = static_cast<double>(field[static_cast<size_t>(v * kWidth + u)]);
      mean += value;
      tilt_u += value * (u - 319.5) / 185;  // 185 px: rms of u - 319.5
      tilt_v += value * (v - 239.5) / 139;
    }
  }
  EXPECT_NEAR(Product(field, 0, 0), 1, 0.1);
  EXPECT_NEAR(mean / (kWidth * kHeight), 0, 0.05);
  EXPECT_NEAR(tilt_u / (kWidth * kHeight), 0, 0.05);
  EXPECT_NEAR(tilt_v / (kWidth * kHeight), 0, 0.05);
}

TEST(DisparityNoiseTest, SmoothFieldsOfManySensorsAreHalfCorrelatedAt75Pixels) {
  double at_75_px = 0, all = 0;
  for (uint64_t sensor = 1; sensor <= 12; ++sensor) {
    const std::vector<float> field = SmoothField(kWidth, kHeight, 72, sensor);
    all += 2 * Product(field, 0, 0);
    at_75_px += Product(field, 75, 0) + Product(field, 0, 75);
  }
  EXPECT_NEAR(at_75_px / all, 0.5, 0.06);
}

}  // namespace
}  // namespace declutter
