#include "tests/paper/repeatability.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "modules/scene_renderer/scene_text.h"

namespace declutter::experiments {
namespace {

constexpr char kScene[] =
    "object { box { size_x_m: 0.18 size_y_m: 0.08 size_z_m: 0.13 } x_m: -0.12 y_m: 0.65 yaw_rad: "
    "0.4 }"
    "object { box { size_x_m: 0.08 size_y_m: 0.06 size_z_m: 0.2 } x_m: 0.04 y_m: 0.75 }"
    "object { cylinder { radius_m: 0.04 height_m: 0.15 } x_m: 0.1 y_m: 0.6 }"
    "object { cylinder { radius_m: 0.03 height_m: 0.1 } x_m: 0.02 y_m: 0.55 }";

TEST(Repeatability, SeedsChangeTheVotesButNoMeasureByMoreThanAHundredthOfAMillimetre) {
  const PreparedFrame frame =
      Prepare(Render(ParseScene(kScene, "scene"), 1), FeatureMode::kDefault);
  Repeatability measured;
  std::set<std::vector<int>> votes;  // of all objects
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    Method method = Voting();
    method.segmenter.set_seed(seed);
    method.segmenter.set_num_samples(1);  // so few that some iterations miss an object
    const Result result = RunMethod(method, frame);
    measured.Add(frame, result);
    EXPECT_GE(result.num_right_hypotheses, 4u);
    EXPECT_LT(result.num_right_hypotheses, result.num_hypotheses);
    std::vector<int> votes_of_seed;
    for (const ObjectModel& object : result.found.objects) {
      votes_of_seed.push_back(object.num_votes);
    }
    votes.insert(votes_of_seed);
  }
  EXPECT_EQ(measured.num_right, 10 * 4);
  EXPECT_THAT(votes, testing::SizeIs(testing::Gt(2)));
  EXPECT_LE(measured.LargestRangeM(), 0.01e-3);
}

// A frame with one box 180 mm wide and 80 mm deep straight ahead, as found with errors.
Result FoundWith(const PreparedFrame& frame, double width_error_m, double depth_error_m) {
  Result result;
  ObjectModel model;
  model.solid = *frame.truth.objects[0].solid;
  model.solid.size += Eigen::Vector3d(width_error_m, depth_error_m, 0);
  result.found.objects = {model};
  result.score.objects.resize(1);
  result.score.objects[0].model = 0;
  return result;
}

TEST(Repeatability, TellsWidthFromDepthAndErrorFromSpread) {
  const PreparedFrame frame = Prepare(
      Render(ParseScene("object { box { size_x_m: 0.18 size_y_m: 0.08 size_z_m: 0.13 } y_m: 0.65 }",
                        "scene"),
             1),
      FeatureMode::kDefault);
  Repeatability measured;
  measured.Add(frame, FoundWith(frame, -0.001, 0.004));
  measured.Add(frame, FoundWith(frame, -0.003, 0.004));
  EXPECT_NEAR(measured.BoxWidth().mean_mm, 2, 1e-9);
  EXPECT_NEAR(measured.BoxWidth().sd_mm, std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(measured.BoxDepth().mean_mm, 4, 1e-9);
  EXPECT_NEAR(measured.BoxDepth().sd_mm, 0, 1e-9);
  EXPECT_NEAR(measured.LargestRangeM(), 0.002, 1e-9);
  EXPECT_EQ(measured.num_wanted, 2);
  EXPECT_EQ(measured.num_right, 2);
}

}  // namespace
}  // namespace declutter::experiments
