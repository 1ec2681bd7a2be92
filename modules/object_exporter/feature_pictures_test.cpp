#include "modules/object_exporter/feature_pictures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace declutter {
namespace {

using testing::ElementsAre;

std::vector<int> At(const ColorImage& image, int u, int v) {
  const auto first = image.rgb.begin() + 3 * (v * image.width + u);
  return {first, first + 3};
}

FeatureCloud TwoPoints(FeatureMode mode) {
  FeatureCloud cloud;
  cloud.mode = mode;
  cloud.width = 4;
  cloud.height = 3;
  cloud.points.resize(2);
  cloud.points[0].pixel = 0;  // flat
  cloud.points[0].r_min = 0.2f;
  cloud.points[1].pixel = 6;  // round
  cloud.points[1].kappa = 25;
  cloud.points[1].curvature = 0.03f;
  cloud.points[1].r_min = 0;
  return cloud;
}

TEST(FeaturePictures, PaintLowCurvatureRedAndHighCurvatureBlue) {
  for (const FeatureMode mode : {FeatureMode::kDefault, FeatureMode::kPaper}) {
    const ColorImage image = DrawFeatures(TwoPoints(mode), std::nullopt).curvature;
    EXPECT_THAT(At(image, 0, 0), ElementsAre(255, 0, 0));
    EXPECT_THAT(At(image, 2, 1), ElementsAre(0, 0, 255));
    EXPECT_THAT(At(image, 3, 2), ElementsAre(0, 0, 0));
  }
}

TEST(FeaturePictures, PaintSmallRadiiRedAndFlatSurfacesBlue) {
  const ColorImage paper = DrawFeatures(TwoPoints(FeatureMode::kPaper), std::nullopt).r_min;
  EXPECT_THAT(At(paper, 0, 0), ElementsAre(0, 0, 255));
  EXPECT_THAT(At(paper, 2, 1), ElementsAre(255, 0, 0));
  // 40 mm, a third of the scale.
  const ColorImage kappa = DrawFeatures(TwoPoints(FeatureMode::kDefault), std::nullopt).r_min;
  EXPECT_THAT(At(kappa, 0, 0), ElementsAre(0, 0, 255));
  EXPECT_THAT(At(kappa, 2, 1), ElementsAre(170, 255, 0));
}

TEST(FeaturePictures, FillThePixelsThatThinningAndDecimationLeftOut) {
  FeatureCloud cloud = TwoPoints(FeatureMode::kDefault);
  cloud.thinning = 2;
  cloud.points.resize(1);
  const ColorImage image = DrawFeatures(cloud, Decimation{2, 7, 5}).curvature;
  EXPECT_EQ(image.width, 7);
  EXPECT_EQ(image.height, 5);
  EXPECT_THAT(At(image, 3, 3), ElementsAre(255, 0, 0));
  EXPECT_THAT(At(image, 4, 3), ElementsAre(0, 0, 0));
}

}  // namespace
}  // namespace declutter
