#include "modules/hough_segmenter/hough_segmenter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "modules/feature_estimator/feature_estimator.h"
#include "modules/plane_filter/plane_filter.h"
#include "modules/scene_renderer/scene_renderer.h"
#include "modules/scene_renderer/scene_text.h"

namespace declutter {
namespace {

RenderedScene RenderText(const std::string& text) { return Render(ParseScene(text, "scene"), 1); }

// Of the features, those of every step-th row and column are used.
HypothesisList Segment(const RenderedScene& scene, const std::string& mode, int step = 1) {
  DepthFrame frame;
  frame.header.utime = 33333;
  frame.header.frame = "scene";
  frame.image = scene.depth;
  FeatureEstimatorConfig features;
  features.set_mode(mode);
  const Tabletop tabletop = PlaneFilter(PlaneFilterConfig()).Filter(frame);
  FeatureCloud cloud = FeatureEstimator(features).Estimate(tabletop);
  const auto is_left_out = [&](const FeaturePoint& point) {
    return point.pixel % cloud.width % step != 0 || point.pixel / cloud.width % step != 0;
  };
  cloud.points.erase(std::remove_if(cloud.points.begin(), cloud.points.end(), is_left_out),
                     cloud.points.end());
  cloud.thinning = step;
  return HoughSegmenter(HoughSegmenterConfig()).Segment(tabletop, cloud);
}

// [m] largest difference of centre and sizes of the hypothesis that is most like the true object.
double SmallestError(const HypothesisList& list, const Solid& truth) {
  double smallest = 1;
  for (const Hypothesis& hypothesis : list.hypotheses) {
    const Solid& solid = hypothesis.solid;
    if (solid.shape != truth.shape) continue;
    Eigen::Vector3d size = solid.size;
    Eigen::Vector3d true_size = truth.size;
    std::sort(size.data(), size.data() + 2);
    std::sort(true_size.data(), true_size.data() + 2);
    smallest = std::min(
        smallest,
        std::max((size - true_size).cwiseAbs().maxCoeff(),
                 (solid.X_CO.translation() - truth.X_CO.translation()).cwiseAbs().maxCoeff()));
  }
  return smallest;
}

class HoughSegmenterInMode : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Modes, HoughSegmenterInMode, testing::Values("default", "paper"));

TEST_P(HoughSegmenterInMode, ProposesACylinderNearTheTruth) {
  const RenderedScene scene =
      RenderText("object { cylinder { radius_m: 0.04 height_m: 0.15 } x_m: 0.05 y_m: 0.6 }");
  const HypothesisList list = Segment(scene, GetParam());
  EXPECT_EQ(list.mode == FeatureMode::kPaper, std::string(GetParam()) == "paper");
  EXPECT_LT(SmallestError(list, scene.objects[0].solid), 0.010);
}

TEST_P(HoughSegmenterInMode, ProposesABoxNearTheTruth) {
  const RenderedScene scene = RenderText(
      "object { box { size_x_m: 0.18 size_y_m: 0.08 size_z_m: 0.13 } y_m: 0.65 yaw_rad: 0.4 }");
  EXPECT_LT(SmallestError(Segment(scene, GetParam()), scene.objects[0].solid), 0.012);
}

TEST(HoughSegmenter, ProposesBothOfTwoTouchingBoxes) {
  const RenderedScene scene = RenderText(
      "object { box { size_x_m: 0.12 size_y_m: 0.08 size_z_m: 0.18 } x_m: -0.06 y_m: 0.65 }"
      "object { box { size_x_m: 0.10 size_y_m: 0.07 size_z_m: 0.10 } x_m: 0.05 y_m: 0.69 }");
  const HypothesisList list = Segment(scene, "default");
  EXPECT_LT(SmallestError(list, scene.objects[0].solid), 0.012);
  EXPECT_LT(SmallestError(list, scene.objects[1].solid), 0.012);
}

TEST(HoughSegmenter, ProposesADiscSeenFromFarAbove) {
  const RenderedScene scene = RenderText(
      "camera { width: 320 height: 240 fx: 285 fy: 285 cx: 159.5 cy: 119.5 height_m: 1.5 "
      "pitch_rad: 1.57 } table { y_m: 0 } "
      "object { cylinder { radius_m: 0.05 height_m: 0.15 } y_m: 0.1 }");
  double radius = 0;
  for (const Hypothesis& hypothesis : Segment(scene, "default").hypotheses) {
    if (hypothesis.solid.shape != Shape::kCylinder) continue;
    radius = std::max(radius, hypothesis.solid.radius());
  }
  EXPECT_NEAR(radius, 0.05, 0.0015);
}

TEST(HoughSegmenter, LeavesOpenHowFarAHiddenBottomReaches) {
  const RenderedScene scene = RenderText(
      "object { box { size_x_m: 0.2 size_y_m: 0.2 size_z_m: 0.06 } y_m: 0.65 }"
      "object { cylinder { radius_m: 0.04 height_m: 0.1 } y_m: 0.65 on: 0 }");
  bool has_open_cylinder = false;
  for (const Hypothesis& hypothesis : Segment(scene, "default").hypotheses) {
    has_open_cylinder |= hypothesis.solid.shape == Shape::kCylinder &&
                         hypothesis.evidence[2] == Evidence::kAssumed &&
                         std::abs(hypothesis.solid.radius() - 0.04) < 0.004;
  }
  EXPECT_TRUE(has_open_cylinder);
}

TEST(HoughSegmenter, ProposesSmallObjectsOfWhichEverySecondPixelHasFeatures) {
  const RenderedScene scene = RenderText(
      "object { box { size_x_m: 0.04 size_y_m: 0.05 size_z_m: 0.05 } x_m: -0.06 y_m: 0.65 }"
      "object { cylinder { radius_m: 0.02 height_m: 0.08 } x_m: 0.06 y_m: 0.65 }");
  const HypothesisList list = Segment(scene, "default", 2);
  EXPECT_LT(SmallestError(list, scene.objects[0].solid), 0.012);
  EXPECT_LT(SmallestError(list, scene.objects[1].solid), 0.012);
}

TEST(HoughSegmenter, GivesTheSameListForTheSameInput) {
  const RenderedScene scene = RenderText(
      "object { box { size_x_m: 0.18 size_y_m: 0.08 size_z_m: 0.13 } y_m: 0.65 yaw_rad: 0.4 }");
  const HypothesisList a = Segment(scene, "default");
  const HypothesisList b = Segment(scene, "default");
  ASSERT_EQ(a.hypotheses.size(), b.hypotheses.size());
  for (size_t i = 0; i < a.hypotheses.size(); ++i) {
    EXPECT_EQ(a.hypotheses[i].solid.size, b.hypotheses[i].solid.size);
    EXPECT_EQ(a.hypotheses[i].num_votes, b.hypotheses[i].num_votes);
  }
}

TEST(HoughSegmenter, ProposesNothingOnAnEmptyTableOrInAnEmptyFrame) {
  EXPECT_THAT(Segment(RenderText(""), "default").hypotheses, testing::IsEmpty());
  const HypothesisList list =
      HoughSegmenter(HoughSegmenterConfig()).Segment(Tabletop(), FeatureCloud());
  EXPECT_THAT(list.hypotheses, testing::IsEmpty());
}

// Upright squares that face the camera, num_columns x num_rows of them side by side and all in all
// as large as the image, each a component; every other one is 5 cm nearer.
struct Tiles {
  Tabletop tabletop;
  FeatureCloud features;

  Tiles(int width, int num_columns, int num_rows) {
    const int height = width * 3 / 4;
    tabletop.planes = {{Plane{Eigen::Vector3d(0, -1, 0), 0.6}, {}}};
    tabletop.objects.camera = {
        width, height, 0.8 * width, 0.8 * width, 0.5 * width - 0.5, 0.5 * height - 0.5};
    features.width = width;
    features.height = height;
    features.num_components = num_columns * num_rows;
    for (int v = 0; v < height; ++v) {
      for (int u = 0; u < width; ++u) {
        const int column = u * num_columns / width, row = v * num_rows / height;
        tabletop.objects.counts.push_back((column + row) % 2 == 0 ? 1000 : 950);
        FeaturePoint point;
        point.pixel = v * width + u;
        point.normal = {0, 0, -1};
        point.component = row * num_columns + column;
        features.points.push_back(point);
      }
    }
  }
};

TEST(HoughSegmenter, FindsEachOfTwoHundredComponents) {
  const Tiles tiles(320, 20, 10);
  HoughSegmenter segmenter{HoughSegmenterConfig()};
  const HypothesisList list = segmenter.Segment(tiles.tabletop, tiles.features);
  std::set<int> found;
  for (const Hypothesis& hypothesis : list.hypotheses) found.insert(hypothesis.component);
  EXPECT_THAT(found, testing::SizeIs(200));
  EXPECT_EQ(segmenter.shortfall(), "");
}

TEST(HoughSegmenter, ProposesTheBestWhereHypothesesAreFew) {
  const Tiles tiles(320, 4, 3);
  HoughSegmenterConfig config;
  const HypothesisList all = HoughSegmenter(config).Segment(tiles.tabletop, tiles.features);
  config.set_max_hypotheses(5);
  HoughSegmenter segmenter(config);
  const HypothesisList best = segmenter.Segment(tiles.tabletop, tiles.features);
  ASSERT_THAT(all.hypotheses, testing::SizeIs(testing::Gt(5)));
  ASSERT_THAT(best.hypotheses, testing::SizeIs(5));
  for (size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(best.hypotheses[i].num_inliers, all.hypotheses[i].num_inliers);
  }
  EXPECT_THAT(segmenter.shortfall(), testing::HasSubstr("left out (max_hypotheses 5)"));
  EXPECT_THAT(segmenter.Segment(Tabletop(), FeatureCloud()).hypotheses, testing::IsEmpty());
  EXPECT_EQ(segmenter.shortfall(), "");
}

TEST(HoughSegmenter, SharesTheTestsOfAFrameAmongItsComponents) {
  const Tiles tiles(320, 4, 3);
  HoughSegmenterConfig config;
  config.set_max_cell_tests(200000);
  config.set_num_iterations(25);
  HoughSegmenter segmenter(config);
  const HypothesisList list = segmenter.Segment(tiles.tabletop, tiles.features);
  std::set<int> found;
  for (const Hypothesis& hypothesis : list.hypotheses) {
    EXPECT_GT(hypothesis.num_votes, 0);
    EXPECT_LT(hypothesis.num_votes, config.num_iterations());
    found.insert(hypothesis.component);
  }
  EXPECT_THAT(found, testing::SizeIs(12));
  EXPECT_EQ(segmenter.shortfall(),
            "voting was cut short in 12 of 12 components (max_cell_tests 200000)");
}

}  // namespace
}  // namespace declutter
