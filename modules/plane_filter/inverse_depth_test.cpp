#include "modules/plane_filter/inverse_depth.h"

#include <gtest/gtest.h>

#include <cmath>

namespace declutter {
namespace {

// What a camera sees of a plane, in steps of 0.1 mm.
DepthImage ImageOf(const Plane& plane) {
  DepthImage image;
  image.camera = {64, 48, 50, 50, 31.5, 23.5};
  image.depth_scale_m = 0.0001;
  for (int v = 0; v < 48; ++v) {
    for (int u = 0; u < 64; ++u) {
      const double z = -plane.d / plane.normal.dot(image.camera.Ray(u, v));
      image.counts.push_back(z > 0 && z < 6 ? static_cast<uint16_t>(std::lround(z * 1e4))
                                            : uint16_t{0});
    }
  }
  return image;
}

const Plane kTable{Eigen::Vector3d(0.1, -0.8, -0.6).normalized(), 0.5};

TEST(InverseDepthTest, InvertsDepthAndLeavesMissingPixelsOut) {
  DepthImage image = ImageOf(kTable);
  image.counts[70] = 0;
  image.counts[71] = 8000;
  const InverseDepth inverse = Invert(image);
  EXPECT_EQ(inverse.values[70], 0);
  EXPECT_FLOAT_EQ(inverse.values[71], 1.25f);
  EXPECT_FLOAT_EQ(inverse.ray_x[63], 31.5f / 50);
  EXPECT_FLOAT_EQ(inverse.ray_y[0], -23.5f / 50);
}

TEST(InverseDepthTest, SubsampleKeepsRaysAndValuesTogether) {
  const InverseDepth image = Invert(ImageOf(kTable));
  const InverseDepth grid = Subsample(image, 4);
  ASSERT_EQ(grid.width, 16);
  ASSERT_EQ(grid.height, 12);
  EXPECT_EQ(grid.ray_x[3], image.ray_x[14]);
  EXPECT_EQ(grid.ray_y[5], image.ray_y[22]);
  EXPECT_EQ(grid.values[grid.Index(3, 5)], image.values[image.Index(14, 22)]);
}

TEST(InverseDepthTest, FitFindsThePlaneFromAPoorStart) {
  const InverseDepth image = Invert(ImageOf(kTable));
  const auto fit = FitInliers(image, nullptr, {0, 1, 1}, 100);
  ASSERT_TRUE(fit);
  const Plane plane = fit->ToPlane();
  EXPECT_LT((plane.normal - kTable.normal).norm(), 1e-3);
  EXPECT_NEAR(plane.d, 0.5, 1e-3);
}

TEST(InverseDepthTest, FitIgnoresPixelsOutsideTheBand) {
  DepthImage with_object = ImageOf(kTable);
  for (size_t i = 1000; i < 1400; ++i) with_object.counts[i] /= 2;
  const InverseDepth clean = Invert(ImageOf(kTable));
  const auto truth = FitInliers(clean, nullptr, {0, 1, 1}, 100);
  ASSERT_TRUE(truth);
  const auto fit = FitInliers(Invert(with_object), nullptr, *truth, 0.01f);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->ToPlane().d, 0.5, 1e-3);
}

TEST(InverseDepthTest, PixelsOfOneRowFixNoPlane) {
  const InverseDepth image = Invert(ImageOf(kTable));
  PixelMask row(image.values.size());
  std::fill(row.begin() + 640, row.begin() + 704, uint8_t{1});
  EXPECT_FALSE(FitInliers(image, &row, {0, 1, 1}, 100));
}

TEST(InverseDepthTest, TheBandIsAsWideInInverseDepthEverywhere) {
  const InverseDepth image = Invert(ImageOf(kTable));
  const auto plane = FitInliers(image, nullptr, {0, 1, 1}, 100);
  ASSERT_TRUE(plane);
  InverseDepth raised = image;
  for (float& value : raised.values) value += value > 0 ? 0.01f : 0.0f;
  const PixelMask narrow = PlaneInliers(raised, *plane, 0.008f);
  const PixelMask wide = PlaneInliers(raised, *plane, 0.012f);
  EXPECT_EQ(std::count(narrow.begin(), narrow.end(), 1), 0);
  EXPECT_EQ(std::count(wide.begin(), wide.end(), 1),
            std::count_if(image.values.begin(), image.values.end(), [](float q) { return q > 0; }));
}

}  // namespace
}  // namespace declutter
