#include "tests/accuracy/summary.h"

#include <gtest/gtest.h>

namespace declutter::accuracy {
namespace {

TrueObject CoreBox(const Eigen::Vector3d& size) {
  TrueObject object;
  object.shape = Shape::kBox;
  object.shape_name = "box";
  object.size = size;
  return object;
}

ObjectModel BoxModel(const Eigen::Vector3d& size) {
  ObjectModel model;
  model.solid.size = size;
  return model;
}

const std::vector<double>* Errors(const Summary& summary, const std::string& name) {
  for (const auto& [known, errors] : summary.errors) {
    if (known == name) return &errors;
  }
  return nullptr;
}

// One frame: a core box that is found, one that is missed, and a false cylinder.
ScoredFrame OneOfEach() {
  ScoredFrame frame;
  frame.truth.frame = "shelf_a";
  frame.truth.group = "shelf";
  frame.has_result = true;
  frame.truth.objects = {CoreBox({0.30, 0.10, 0.20}), CoreBox({0.1, 0.1, 0.1})};
  frame.found.objects = {BoxModel({0.101, 0.302, 0.203}), BoxModel({0.1, 0.1, 0.1})};
  frame.found.objects[1].solid.shape = Shape::kCylinder;
  frame.score.objects = {{0, 0.9, ""}, {std::nullopt, 0.0, "no model on it"}};
  frame.score.models = {{Verdict::kRight, 0, true, 0.9, ""},
                        {Verdict::kFalse, std::nullopt, false, 0.0, "on nothing"}};
  return frame;
}

TEST(Summarize, CountsByGroupAndShape) {
  const Summary summary = Summarize({OneOfEach()});
  const GroupCount& group = summary.groups.at("shelf");
  EXPECT_EQ(group.shapes[0].num_core, 2);
  EXPECT_EQ(group.shapes[0].num_found, 1);
  EXPECT_DOUBLE_EQ(group.shapes[0].Recall(), 0.5);
  EXPECT_DOUBLE_EQ(group.shapes[0].Precision(), 1.0);
  EXPECT_EQ(group.shapes[1].num_false, 1);
  EXPECT_DOUBLE_EQ(group.shapes[1].Precision(), 0.0);
  EXPECT_EQ(summary.total.shapes[0].num_core, 2);
  EXPECT_DOUBLE_EQ(summary.median_iou.value(), 0.9);
}

TEST(Summarize, ComparesExtentsOfBoxesInAnyOrder) {
  const Summary summary = Summarize({OneOfEach()});
  EXPECT_NEAR(Errors(summary, "box long mm")->at(0), 2, 1e-9);
  EXPECT_NEAR(Errors(summary, "box middle mm")->at(0), 3, 1e-9);
  EXPECT_NEAR(Errors(summary, "box short mm")->at(0), 1, 1e-9);
}

TEST(Summarize, ComparesObservedExtentsWithTheLikeliestOfTheSize) {
  ScoredFrame frame = OneOfEach();
  frame.found.objects[0] = BoxModel({0.050, 0.197, 0.101});
  frame.found.objects[0].evidence[0] = Evidence::kAssumed;
  const Summary summary = Summarize({frame});
  EXPECT_NEAR(Errors(summary, "box long mm")->at(0), -250, 1e-9);
  EXPECT_NEAR(Errors(summary, "box middle observed mm")->at(0), -3, 1e-9);
  EXPECT_NEAR(Errors(summary, "box short observed mm")->at(0), 1, 1e-9);
  EXPECT_NEAR(Errors(summary, "box height mm")->at(0), 1, 1e-9);
  EXPECT_EQ(Errors(summary, "box long observed mm"), nullptr);
}

TEST(Summarize, KeepsAssumedExtentsOutOfTheObservedOnes) {
  ScoredFrame frame = OneOfEach();
  frame.found.objects[0].evidence = {Evidence::kObserved, Evidence::kAssumed, Evidence::kFreeSpace};
  const Summary summary = Summarize({frame});
  EXPECT_EQ(Errors(summary, "box extents mm")->size(), 3u);
  EXPECT_EQ(Errors(summary, "box extents observed mm")->size(), 1u);
  EXPECT_EQ(Errors(summary, "box long observed mm"), nullptr);
}

TEST(Summarize, NamesFramesWithoutResult) {
  ScoredFrame frame = OneOfEach();
  frame.has_result = false;
  EXPECT_EQ(Summarize({frame}).without_result, std::vector<std::string>{"shelf_a"});
}

TEST(Summarize, CountsMatchesWithin20MmAmongObjectsOfExactTruth) {
  ScoredFrame frame = OneOfEach();
  frame.truth.objects[0].solid = BoxModel({0.101, 0.302, 0.224}).solid;
  frame.truth.objects[1].solid = BoxModel({0.1, 0.1, 0.1}).solid;
  Summary summary = Summarize({frame});
  EXPECT_EQ(summary.num_exact, 2);
  EXPECT_EQ(summary.num_within_20_mm, 0);
  frame.truth.objects[0].solid->size.z() = 0.222;
  EXPECT_EQ(Summarize({frame}).num_within_20_mm, 1);
}

TEST(Summarize, CountsTrueValuesInsideTheIntervals) {
  ScoredFrame frame = OneOfEach();
  frame.truth.objects[0].solid = frame.found.objects[0].solid;
  frame.truth.objects[0].solid->size.z() -= 0.010;
  EXPECT_EQ(Summarize({frame}).num_estimates, 0);
  SolidCovariance& covariance = frame.found.objects[0].covariance;
  covariance = SolidCovariance::Identity() * 1e-6;
  Summary summary = Summarize({frame});
  EXPECT_EQ(summary.num_estimates, 7);
  EXPECT_EQ(summary.num_in_interval, 6);
  covariance(5, 5) = 0.006 * 0.006;
  EXPECT_EQ(Summarize({frame}).num_in_interval, 7);
}

TEST(Summarize, CountsRadiiApartThatAreWellSeenOrWellKnown) {
  ScoredFrame frame = OneOfEach();
  TrueObject& can = frame.truth.objects[1];
  can.shape = Shape::kCylinder;
  frame.score.objects[1].model = 1;
  can.num_px = 1500;
  can.visible_fraction = 0.8;
  can.size_tolerance_m = 0.005;
  Summary summary = Summarize({frame});
  EXPECT_EQ(Errors(summary, "cylinder radius well seen mm"), nullptr);
  EXPECT_EQ(Errors(summary, "cylinder radius well known mm"), nullptr);
  can.visible_fraction = 0.9;
  can.size_tolerance_m = 0.004;
  summary = Summarize({frame});
  ASSERT_NE(Errors(summary, "cylinder radius well seen mm"), nullptr);
  ASSERT_NE(Errors(summary, "cylinder radius well known mm"), nullptr);
  EXPECT_NEAR(Errors(summary, "cylinder radius well known mm")->at(0), 0, 1e-9);
}

TEST(Summarize, ComparesRadiiPartlySeenWithTheirBound) {
  ScoredFrame frame = OneOfEach();
  TrueObject& can = frame.truth.objects[1];
  can.shape = Shape::kCylinder;
  frame.score.objects[1].model = 1;
  can.size->x() += 0.004;
  can.radius_bound_m = 0.0005;
  const Summary summary = Summarize({frame});
  ASSERT_NE(Errors(summary, "cylinder radius partly seen, bounds"), nullptr);
  EXPECT_NEAR(Errors(summary, "cylinder radius partly seen, bounds")->at(0), -4, 1e-9);
  can.num_px = 1500;
  can.visible_fraction = 0.9;
  EXPECT_EQ(Errors(Summarize({frame}), "cylinder radius partly seen, bounds"), nullptr);
}

TEST(SpreadOf, GivesMeanAndStandardDeviation) {
  const Spread spread = SpreadOf({-1, 0, 4});
  EXPECT_DOUBLE_EQ(spread.mean, 1);
  EXPECT_NEAR(spread.sd, 2.6458, 1e-4);
  EXPECT_EQ(SpreadOf({3}).sd, 0);
}

TEST(SpreadOf, GivesSignedAndAbsoluteQuantiles) {
  const Spread spread = SpreadOf({-4, -3, -2, 1, 10});
  EXPECT_DOUBLE_EQ(spread.median, -2);
  EXPECT_DOUBLE_EQ(spread.median_abs, 3);
  EXPECT_DOUBLE_EQ(spread.p90_abs, 7.6);
  EXPECT_EQ(spread.num, 5u);
}

}  // namespace
}  // namespace declutter::accuracy
