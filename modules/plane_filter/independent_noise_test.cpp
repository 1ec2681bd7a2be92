#include "modules/plane_filter/independent_noise.h"

#include <gtest/gtest.h>

#include <random>

namespace declutter {
namespace {

// A plane aslant, with noise [1/m] that `num_sharing` pixels of a row have in common.
InverseDepth NoisyPlane(double sigma, int num_sharing) {
  InverseDepth image;
  image.width = 160;
  image.height = 120;
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, sigma);
  for (int v = 0; v < image.height; ++v) {
    double shared = 0;
    for (int u = 0; u < image.width; ++u) {
      if (u % num_sharing == 0) shared = noise(random);
      image.values.push_back(static_cast<float>(1 + 0.002 * u + 0.004 * v + shared));
    }
  }
  return image;
}

double NoiseOf(const InverseDepth& image) {
  std::vector<float> buffer;
  return IndependentNoise(image, &buffer);
}

TEST(IndependentNoise, IsWhatPixelsOfAPlaneDifferBy) {
  EXPECT_NEAR(NoiseOf(NoisyPlane(0.01, 1)), 0.01, 0.001);
  EXPECT_LT(NoiseOf(NoisyPlane(0, 1)), 1e-6);
}

TEST(IndependentNoise, HasNoPartInWhatNeighboursShare) {
  EXPECT_LT(NoiseOf(NoisyPlane(0.01, 5)), 0.005);
}

TEST(IndependentNoise, IsTheSameBesideSteps) {
  InverseDepth image = NoisyPlane(0.01, 1);
  for (size_t i = 0; i < image.values.size(); ++i) {
    if (i / 10 % 2 == 0) image.values[i] += 0.5f;
  }
  EXPECT_NEAR(NoiseOf(image), 0.01, 0.005);
}

TEST(IndependentNoise, IsNoneWhereNothingIsMeasured) {
  InverseDepth image = NoisyPlane(0.01, 1);
  image.values.assign(image.values.size(), 0);
  EXPECT_EQ(NoiseOf(image), 0);
}

}  // namespace
}  // namespace declutter
