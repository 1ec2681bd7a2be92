#include "tests/accuracy/scene_truth.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace declutter::accuracy {
namespace {

TEST(ParseSceneTruth, ReadsACylinderWithLabelsAndProductSize) {
  const SceneTruth truth = ParseSceneTruth(nlohmann::json::parse(R"({
    "width": 640, "height": 480, "table_plane": {"normal_cam": [0, -0.6, -0.8], "d": 0.6},
    "objects": [{"id": 5, "labels": [50, 51], "product": "cup", "shape": "cylinder",
                 "pose": "axis_vertical", "scope": "core", "seed_px": [395, 318], "n_px": 2300,
                 "circle_fit": {"radius": 0.04, "axis_point_cam": [0.1, 0.1, 0.77]},
                 "product_size": {"radius": 0.036, "height": 0.098, "tol": 0.006}}]})"));
  ASSERT_EQ(truth.objects.size(), 1u);
  const TrueObject& cup = truth.objects[0];
  EXPECT_EQ(cup.id, 5);
  EXPECT_EQ(cup.name, "cup");
  EXPECT_EQ(cup.shape, Shape::kCylinder);
  EXPECT_EQ(cup.stance, Stance::kStanding);
  EXPECT_EQ(cup.labels, (std::vector<int>{50, 51}));
  EXPECT_EQ(*cup.size, Eigen::Vector3d(0.072, 0.072, 0.098));
  EXPECT_EQ(*cup.size_tolerance_m, 0.006);
  EXPECT_EQ(*cup.num_px, 2300);
  EXPECT_EQ(*cup.distance_m, 0.77);
  EXPECT_FALSE(cup.solid);
  EXPECT_NEAR(truth.up_C.z(), -0.8, 1e-12);
}

TEST(ParseSceneTruth, CountsIdsFromOneWhereThereAreNone) {
  const SceneTruth truth = ParseSceneTruth(nlohmann::json::parse(R"({
    "width": 640, "height": 480,
    "objects": [{"name": "a", "shape": "box", "scope": "core"},
                {"name": "b", "shape": "other", "scope": "out", "pose": "tilted"}]})"));
  EXPECT_EQ(truth.objects[1].id, 2);
  EXPECT_FALSE(truth.objects[1].shape);
  EXPECT_EQ(truth.objects[1].stance, Stance::kLeaning);
  EXPECT_EQ(truth.objects[1].scope, Scope::kOut);
}

TEST(ParseSceneTruth, LeavesOutOfTheScoreWhatAKnownProblemNames) {
  const SceneTruth truth = ParseSceneTruth(nlohmann::json::parse(R"({
    "width": 640, "height": 480,
    "known_problems": ["pixels without a point are 0", "object 7 is two things; do not score it"],
    "objects": [{"id": 6, "shape": "box", "scope": "core"},
                {"id": 7, "shape": "other", "scope": "out"}]})"));
  EXPECT_EQ(truth.objects[0].scope, Scope::kCore);
  EXPECT_EQ(truth.objects[1].scope, Scope::kUnscored);
}

TEST(ParseSceneTruth, ReadsTheExactPoseAndSizeOfARenderedBox) {
  const SceneTruth truth = ParseSceneTruth(nlohmann::json::parse(R"({
    "width": 640, "height": 480,
    "objects": [{"id": 2, "labels": [20], "shape": "box", "scope": "core",
                 "known_size": {"dims": [0.3, 0.2, 0.1]},
                 "truth": {"position": [0.1, 0.2, 0.9], "orientation": [0, 1, 0, 0],
                           "size": [0.1, 0.3, 0.2], "visible_fraction": 0.4}}]})"));
  const TrueObject& box = truth.objects[0];
  ASSERT_TRUE(box.solid);
  EXPECT_EQ(box.solid->size, Eigen::Vector3d(0.1, 0.3, 0.2));
  EXPECT_EQ(box.solid->X_CO.translation(), Eigen::Vector3d(0.1, 0.2, 0.9));
  EXPECT_NEAR(box.solid->X_CO.linear()(2, 2), -1, 1e-12);
  EXPECT_EQ(*box.distance_m, 0.9);
  EXPECT_EQ(*box.visible_fraction, 0.4);
}

TEST(ParseSceneTruth, RefusesAScopeItDoesNotKnow) {
  EXPECT_THROW(ParseSceneTruth(nlohmann::json::parse(R"({
    "width": 640, "height": 480, "objects": [{"shape": "box", "scope": "cor"}]})")),
               std::runtime_error);
}

TEST(ParseSceneTruth, RefusesASceneWithoutItsSize) {
  EXPECT_THROW(ParseSceneTruth(nlohmann::json::parse(R"({"objects": []})")), std::runtime_error);
}

}  // namespace
}  // namespace declutter::accuracy
