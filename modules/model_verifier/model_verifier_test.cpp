#include "modules/model_verifier/model_verifier.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "modules/model_verifier/cylinder_refinement.h"
#include "modules/model_verifier/end_evidence.h"
#include "modules/model_verifier/refinement.h"
#include "modules/model_verifier/test_scene.h"

namespace declutter {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

Hypothesis Proposal(const Solid& solid) {
  Hypothesis hypothesis;
  hypothesis.solid = solid;
  return hypothesis;
}

// The same where no lower end was seen.
Hypothesis ProposalOfUpperPart(const Solid& solid) {
  Hypothesis hypothesis = Proposal(solid);
  hypothesis.evidence[2] = Evidence::kAssumed;
  return hypothesis;
}

// The solid, moved and resized in its own frame.
Solid Changed(Solid solid, const Eigen::Vector3d& shift_O, const Eigen::Vector3d& growth) {
  solid.X_CO.translation() += solid.X_CO.linear() * shift_O;
  solid.size += growth;
  return solid;
}

RenderedScene RenderText(const std::string& text) { return Render(ParseScene(text, "scene"), 1); }

ObjectList Verify(const RenderedScene& scene, const std::vector<Hypothesis>& hypotheses) {
  DepthFrame frame;
  frame.header.utime = 33333;
  frame.header.frame = "scene";
  frame.image = scene.depth;
  HypothesisList list;
  list.header = frame.header;
  list.planes = {scene.table};
  list.hypotheses = hypotheses;
  return ModelVerifier(ModelVerifierConfig()).Verify(frame, list);
}

Solid RefineOn(const RenderedScene& scene, const Solid& solid) {
  ObservedImage observed;
  observed.Set(scene.depth, scene.table);
  FitPoints buffer;
  return Refine(solid, observed.every_pixel(), &buffer);
}

// What is made of a can and a box before it when the can is proposed as a box with this growth.
ObjectList VerifyCanAsBox(const RenderedScene& scene, const Eigen::Vector3d& growth) {
  Solid box = Changed(scene.objects[0].solid, {0, 0, 0}, growth);
  box.shape = Shape::kBox;
  return Verify(scene, {Proposal(box), Proposal(scene.objects[1].solid)});
}

constexpr char kBox[] =
    "object { box { size_x_m: 0.18 size_y_m: 0.08 size_z_m: 0.13 } y_m: 0.65 yaw_rad: 0.4 }";

TEST(ModelVerifier, AcceptsATrueBoxAndLabelsItsPixels) {
  const RenderedScene scene = RenderText(kBox);
  const ObjectList list = Verify(scene, {Proposal(scene.objects[0].solid)});
  ASSERT_THAT(list.objects, SizeIs(1));
  EXPECT_GT(list.objects[0].confidence, 0.9);
  int num_both = 0;
  int num_either = 0;
  for (size_t i = 0; i < list.labels.size(); ++i) {
    const bool is_true = scene.labels[i] == scene.objects[0].label;
    num_both += is_true && list.labels[i] == 1;
    num_either += is_true || list.labels[i] == 1;
  }
  EXPECT_GT(num_both, 0.9 * num_either);
}

TEST(ModelVerifier, RejectsWhatFreeSpaceContradicts) {
  const RenderedScene scene = RenderText(kBox);
  const Solid floating = Changed(scene.objects[0].solid, {0.3, 0, 0}, {0, 0, 0});
  EXPECT_THAT(Verify(scene, {Proposal(floating)}).objects, IsEmpty());
}

TEST(ModelVerifier, PrefersTheShapeThatFits) {
  const RenderedScene scene =
      RenderText("object { cylinder { radius_m: 0.04 height_m: 0.15 } x_m: 0.05 y_m: 0.6 }");
  Solid box = scene.objects[0].solid;
  box.shape = Shape::kBox;
  const ObjectList list = Verify(scene, {Proposal(box), Proposal(scene.objects[0].solid)});
  ASSERT_THAT(list.objects, SizeIs(1));
  EXPECT_EQ(list.objects[0].solid.shape, Shape::kCylinder);
}

TEST(ModelVerifier, TriesTheOtherShapeWhereTheProposedOneFitsBadly) {
  // A box in front hides much of the can.
  const RenderedScene scene = RenderText(
      "object { cylinder { radius_m: 0.03 height_m: 0.1 } y_m: 0.7 }"
      "object { box { size_x_m: 0.1 size_y_m: 0.04 size_z_m: 0.07 } x_m: -0.06 y_m: 0.62 }");
  const ObjectList list = VerifyCanAsBox(scene, {-0.008, -0.008, 0});
  ASSERT_THAT(list.objects, SizeIs(2));
  EXPECT_EQ(list.objects[1].solid.shape, Shape::kCylinder);
  EXPECT_NEAR(list.objects[1].solid.radius(), 0.03, 0.003);
}

TEST(ModelVerifier, TriesTheOtherShapeWhereTheProposedOneFitsWellToo) {
  // Only a part of its top is seen of the tin.
  const RenderedScene scene = RenderText(
      "object { cylinder { radius_m: 0.045 height_m: 0.05 } y_m: 0.735 }"
      "object { box { size_x_m: 0.1 size_y_m: 0.04 size_z_m: 0.09 } x_m: -0.01 y_m: 0.66 }");
  const ObjectList list = VerifyCanAsBox(scene, {-0.012, -0.006, 0});
  ASSERT_THAT(list.objects, SizeIs(2));
  EXPECT_EQ(list.objects[0].solid.shape, Shape::kCylinder);
  EXPECT_NEAR(list.objects[0].solid.radius(), 0.045, 0.003);
}

TEST(ModelVerifier, SetsAStackOnEachOther) {
  const RenderedScene scene = RenderText(
      "object { box { size_x_m: 0.2 size_y_m: 0.2 size_z_m: 0.06 } y_m: 0.65 }"
      "object { cylinder { radius_m: 0.04 height_m: 0.1 } y_m: 0.65 on: 0 }");
  // Of the can only the upper part was seen.
  const Hypothesis can =
      ProposalOfUpperPart(Changed(scene.objects[1].solid, {0, 0, 0.01}, {0, 0, -0.02}));
  const ObjectList list = Verify(scene, {can, Proposal(scene.objects[0].solid)});
  ASSERT_THAT(list.objects, SizeIs(2));
  const ObjectModel& upper = list.objects[1];
  EXPECT_EQ(upper.solid.shape, Shape::kCylinder);
  EXPECT_EQ(upper.supported_by, list.objects[0].id);
  EXPECT_NEAR(upper.solid.height(), 0.1, 0.003);
}

TEST(ModelVerifier, FindsACanUnderOneThatWasTakenToReachDownThroughIt) {
  const RenderedScene scene = RenderText(
      "object { cylinder { radius_m: 0.032 height_m: 0.088 } y_m: 0.65 }"
      "object { cylinder { radius_m: 0.021 height_m: 0.126 } y_m: 0.65 on: 0 }");
  const Solid deep = Changed(scene.objects[1].solid, {0, 0, -0.044}, {0, 0, 0.088});
  // The lower one was seen badly, and explains less than the deep one.
  const Solid lower = Changed(scene.objects[0].solid, {0, 0, 0}, {-0.01, -0.01, 0});
  const ObjectList list = Verify(scene, {Proposal(deep), Proposal(lower)});
  ASSERT_THAT(list.objects, SizeIs(2));
  EXPECT_NEAR(list.objects[0].solid.radius(), 0.032, 0.002);
  EXPECT_NEAR(list.objects[1].solid.height(), 0.126, 0.003);
  EXPECT_EQ(list.objects[1].supported_by, list.objects[0].id);
}

TEST(ModelVerifier, CutsWhatReachesDownIntoWhatItStandsOn) {
  const RenderedScene scene = RenderText(
      "object { box { size_x_m: 0.2 size_y_m: 0.1 size_z_m: 0.06 } y_m: 0.65 }"
      "object { box { size_x_m: 0.08 size_y_m: 0.06 size_z_m: 0.05 } y_m: 0.63 on: 0 }");
  // The side of the lower box was taken for more of the upper one's, whose place a can would fill.
  const Solid deep = Changed(scene.objects[1].solid, {0, 0, -0.03}, {0, 0, 0.06});
  Solid can = Changed(scene.objects[1].solid, {0, 0, 0}, {-0.01, 0.01, 0});
  can.shape = Shape::kCylinder;
  const ObjectList list =
      Verify(scene, {Proposal(deep), Proposal(can), Proposal(scene.objects[0].solid)});
  ASSERT_THAT(list.objects, SizeIs(2));
  const ObjectModel& upper = list.objects[1];
  EXPECT_EQ(upper.solid.shape, Shape::kBox);
  EXPECT_NEAR(upper.solid.height(), 0.05, 0.003);
  EXPECT_EQ(upper.supported_by, list.objects[0].id);
}

TEST(ModelVerifier, SetsACanOnAWiderOneThatVotesHaveMadeOne) {
  const RenderedScene scene = RenderText(
      "camera { height_m: 0.45 pitch_rad: 0.6 }"
      "object { cylinder { radius_m: 0.0335 height_m: 0.15 } y_m: 0.5 }"
      "object { cylinder { radius_m: 0.027 height_m: 0.08 } y_m: 0.5 on: 0 }");
  // Both circles were found, each with all that is below it and above.
  const Solid& lower = scene.objects[0].solid;
  const Solid wide = Changed(lower, {0, 0, 0.04}, {0, 0, 0.08});
  const Solid narrow = Changed(wide, {0, 0, 0}, {-0.0115, -0.0115, 0});
  const ObjectList list = Verify(scene, {Proposal(narrow), Proposal(wide)});
  ASSERT_THAT(list.objects, SizeIs(2));
  EXPECT_NEAR(list.objects[0].solid.radius(), 0.0335, 0.001);
  EXPECT_NEAR(list.objects[0].solid.height(), 0.15, 0.006);
  EXPECT_NEAR(list.objects[1].solid.radius(), 0.027, 0.001);
  EXPECT_EQ(list.objects[1].supported_by, 1);
}

TEST(ModelVerifier, TakesACartonThatBulgesForOneBox) {
  const RenderedScene scene = RenderText(
      "object { box { size_x_m: 0.196 size_y_m: 0.068 size_z_m: 0.17 } y_m: 0.6 yaw_rad: 0.5 }"
      "object { box { size_x_m: 0.19 size_y_m: 0.056 size_z_m: 0.09 } y_m: 0.6 yaw_rad: 0.5 on: 0 "
      "}");
  const Solid whole = Changed(scene.objects[1].solid, {0, 0, -0.085}, {0, 0, 0.17});
  // Its hidden side was taken to lie farther back.
  const Solid lower = Changed(scene.objects[0].solid, {0, 0.012, 0}, {0, 0.024, 0});
  const ObjectList list = Verify(scene, {Proposal(whole), Proposal(lower)});
  ASSERT_THAT(list.objects, SizeIs(1));
  EXPECT_NEAR(list.objects[0].solid.height(), 0.26, 0.003);
}

TEST(ModelVerifier, UnitesWhatIsSeenOnBothSidesOfAnObstacle) {
  const RenderedScene scene = RenderText(
      "object { box { size_x_m: 0.3 size_y_m: 0.1 size_z_m: 0.05 } y_m: 0.75 }"
      "object { box { size_x_m: 0.06 size_y_m: 0.06 size_z_m: 0.25 } x_m: -0.02 y_m: 0.62 }");
  const Solid& truth = scene.objects[0].solid;
  const Hypothesis left = Proposal(Changed(truth, {-0.1, 0, 0}, {-0.2, 0, 0}));
  const Hypothesis right = Proposal(Changed(truth, {0.085, 0, 0}, {-0.17, 0, 0}));
  const Hypothesis obstacle = Proposal(scene.objects[1].solid);
  const ObjectList list = Verify(scene, {left, right, obstacle});
  ASSERT_THAT(list.objects, SizeIs(2));
  EXPECT_NEAR(list.objects[0].solid.size.x(), 0.3, 0.003);

  // Where the table is seen between them, they are two.
  const RenderedScene apart = RenderText(
      "object { box { size_x_m: 0.1 size_y_m: 0.1 size_z_m: 0.05 } x_m: -0.1 y_m: 0.75 }"
      "object { box { size_x_m: 0.13 size_y_m: 0.1 size_z_m: 0.05 } x_m: 0.085 y_m: 0.75 }");
  EXPECT_THAT(Verify(apart, {left, right}).objects, SizeIs(2));
}

TEST(ModelVerifier, DividesNotAgainWhatItUnites) {
  // Behind an obstacle; a box as a sensor bends it, which two explain somewhat better.
  const RenderedScene scene = RenderText(
      "object { box { size_x_m: 0.105 size_y_m: 0.1 size_z_m: 0.05 } x_m: -0.0975 y_m: 0.75 }"
      "object { box { size_x_m: 0.15 size_y_m: 0.1 size_z_m: 0.053 } x_m: 0.08 y_m: 0.75 "
      "yaw_rad: 0.04 }"
      "object { box { size_x_m: 0.06 size_y_m: 0.06 size_z_m: 0.25 } x_m: -0.02 y_m: 0.62 }"
      "noise { sensor_seed: 35 }");
  std::vector<Hypothesis> hypotheses = {Proposal(scene.objects[2].solid)};
  for (const double growth : {0.0, -0.004}) {
    hypotheses.push_back(
        Proposal(Changed(scene.objects[0].solid, {0.5 * growth, 0, 0}, {growth, 0, 0})));
    hypotheses.push_back(
        Proposal(Changed(scene.objects[1].solid, {-0.5 * growth, 0, 0}, {growth, 0, 0})));
  }
  EXPECT_THAT(Verify(scene, hypotheses).objects, SizeIs(2));
}

TEST(ModelVerifier, LeavesNeighboursOfTwoHeightsApartBehindAnObstacle) {
  const RenderedScene scene = RenderText(
      "object { box { size_x_m: 0.04 size_y_m: 0.06 size_z_m: 0.05 } x_m: -0.0405 y_m: 0.72 }"
      "object { box { size_x_m: 0.04 size_y_m: 0.06 size_z_m: 0.0545 } x_m: 0.0005 y_m: 0.72 }"
      "object { box { size_x_m: 0.025 size_y_m: 0.025 size_z_m: 0.2 } x_m: -0.018 y_m: 0.62 }");
  std::vector<Hypothesis> hypotheses;
  for (const TrueObject& object : scene.objects) hypotheses.push_back(Proposal(object.solid));
  EXPECT_THAT(Verify(scene, hypotheses).objects, SizeIs(3));
}

TEST(ModelVerifier, JoinsPartsOfOneColumn) {
  // Nobody proposes the whole.
  for (const char* text :
       {kBox, "object { cylinder { radius_m: 0.04 height_m: 0.13 } y_m: 0.65 }"}) {
    const RenderedScene scene = RenderText(text);
    const Solid& whole = scene.objects[0].solid;
    const Hypothesis upper = ProposalOfUpperPart(Changed(whole, {0, 0, 0.03}, {0, 0, -0.06}));
    const Hypothesis lower = Proposal(Changed(whole, {0, 0, -0.035}, {0, 0, -0.07}));
    const ObjectList list = Verify(scene, {upper, lower});
    ASSERT_THAT(list.objects, SizeIs(1)) << text;
    EXPECT_NEAR(list.objects[0].solid.height(), 0.13, 0.003) << text;
  }
}

TEST(ModelVerifier, LeavesWhatStandsOnOneOfAnotherOutline) {
  // Turned, across, and set back.
  for (const auto& [size, place] :
       {std::pair("size_x_m: 0.08 size_y_m: 0.08", "y_m: 0.65 yaw_rad: 0.785"),
        std::pair("size_x_m: 0.08 size_y_m: 0.08", "y_m: 0.65 yaw_rad: 0.35"),
        std::pair("size_x_m: 0.14 size_y_m: 0.11", "y_m: 0.65 yaw_rad: 1.5708"),
        std::pair("size_x_m: 0.14 size_y_m: 0.11", "y_m: 0.659")}) {
    const std::string box = "object { box { " + std::string(size);
    const RenderedScene scene = RenderText(box + " size_z_m: 0.04 } y_m: 0.65 }" + box +
                                           " size_z_m: 0.12 } on: 0 " + place + " }");
    const Hypothesis upper = ProposalOfUpperPart(scene.objects[1].solid);
    EXPECT_THAT(Verify(scene, {upper, Proposal(scene.objects[0].solid)}).objects, SizeIs(2))
        << size << place;
  }
}

TEST(ModelVerifier, DividesABoxThatIsSeenThrough) {
  // Of one height, so that one patch holds the tops of both.
  const RenderedScene scene = RenderText(
      "object { box { size_x_m: 0.13 size_y_m: 0.11 size_z_m: 0.109 } y_m: 0.7 }"
      "object { box { size_x_m: 0.082 size_y_m: 0.03 size_z_m: 0.109 } x_m: 0.112 y_m: 0.664 }");
  const Solid& left = scene.objects[0].solid;
  const Solid& right = scene.objects[1].solid;
  const Solid both = Changed(left, {0.044, 0, 0}, {0.088, 0, 0});
  const ObjectList list = Verify(scene, {Proposal(both), Proposal(right)});
  ASSERT_THAT(list.objects, SizeIs(2));
  EXPECT_LT((list.objects[0].solid.size - left.size).norm(), 0.008);
  EXPECT_LT((list.objects[1].solid.size - right.size).norm(), 0.008);
}

TEST(ModelVerifier, DividesABoxOverTwoTopsThatAreSeenFromAbove) {
  const RenderedScene scene = RenderText(
      "camera { height_m: 0.9 pitch_rad: 1.5 } table { y_m: 0 }"
      "object { cylinder { radius_m: 0.023 height_m: 0.15 } x_m: -0.0235 y_m: 0.05 }"
      "object { cylinder { radius_m: 0.023 height_m: 0.15 } x_m: 0.0235 y_m: 0.05 }");
  // Of both only the top was proposed.
  const auto top_of = [](const Solid& solid) {
    return ProposalOfUpperPart(Changed(solid, {0, 0, 0.0725}, {0, 0, -0.145}));
  };
  Solid both = scene.objects[0].solid;
  both.shape = Shape::kBox;
  both.X_CO.translation() =
      0.5 * (both.X_CO.translation() + scene.objects[1].solid.X_CO.translation());
  both.size.x() += 0.047;
  const ObjectList list = Verify(scene, {top_of(both), top_of(scene.objects[0].solid)});
  ASSERT_THAT(list.objects, SizeIs(2));
  for (const ObjectModel& object : list.objects) {
    EXPECT_EQ(object.solid.shape, Shape::kCylinder);
    EXPECT_NEAR(object.solid.radius(), 0.023, 0.002);
  }
}

TEST(ModelVerifier, GivesBackWhatABoxTookOfItsNeighbour) {
  const RenderedScene scene = RenderText(
      "object { box { size_x_m: 0.12 size_y_m: 0.04 size_z_m: 0.073 } y_m: 0.65 yaw_rad: 0.9 }"
      "object { box { size_x_m: 0.046 size_y_m: 0.044 size_z_m: 0.066 }"
      "  x_m: -0.048 y_m: 0.58 yaw_rad: 0.9 }");
  const Solid& box = scene.objects[0].solid;
  const Solid& neighbour = scene.objects[1].solid;
  // It was taken to go on through the neighbour, and that to be smaller.
  const Solid both = Changed(box, {-0.025, 0, 0}, {0.05, 0, 0});
  const Solid rest = Changed(neighbour, {0, 0, 0}, {-0.008, -0.008, 0});
  const ObjectList list = Verify(scene, {Proposal(both), Proposal(rest)});
  ASSERT_THAT(list.objects, SizeIs(2));
  const Solid& given_back = list.objects[0].solid;
  EXPECT_LT((given_back.X_CO.translation() - neighbour.X_CO.translation()).norm(), 0.003);
  EXPECT_NEAR(given_back.size.head<2>().maxCoeff(), 0.046, 0.003);
  EXPECT_NEAR(list.objects[1].solid.size.maxCoeff(), 0.12, 0.008);
}

TEST(ModelVerifier, FindsACanUnderABoxThatWasTakenToReachDownThroughIt) {
  const RenderedScene scene = RenderText(
      "object { cylinder { radius_m: 0.0282 height_m: 0.04 } x_m: -0.0039 y_m: 0.4906 }"
      "object { box { size_x_m: 0.0295 size_y_m: 0.021 size_z_m: 0.04 }"
      "  x_m: -0.0067 y_m: 0.4846 yaw_rad: 0.94 on: 0 }");
  const Solid deep = Changed(scene.objects[1].solid, {0, 0, -0.02}, {0, 0, 0.04});
  // What that leaves of the can was taken for a box.
  Solid rest = scene.objects[0].solid;
  rest.shape = Shape::kBox;
  rest.size.head<2>() = Eigen::Vector2d(0.02, 0.041);
  const ObjectList list =
      Verify(scene, {Proposal(deep), Proposal(Changed(rest, {0.018, 0, 0}, {0, 0, 0}))});
  ASSERT_THAT(list.objects, SizeIs(2));
  EXPECT_EQ(list.objects[0].solid.shape, Shape::kCylinder);
  EXPECT_NEAR(list.objects[0].solid.radius(), 0.0282, 0.003);
  EXPECT_NEAR(list.objects[1].solid.height(), 0.04, 0.003);
  EXPECT_EQ(list.objects[1].supported_by, list.objects[0].id);
}

TEST(ModelVerifier, TakesNoPartOfABowlForACylinder) {
  std::string bowl = "object { cylinder { radius_m: 0.08 height_m: 0.05 } y_m: 0.65 }";
  for (int i = 0; i < 8; ++i) {
    bowl += "object { cylinder { radius_m: " + std::to_string(0.076 - 0.005 * i) +
            " height_m: 0.01 } y_m: 0.65 on: " + std::to_string(i) + " }";
  }
  const RenderedScene scene = RenderText(bowl);
  const Hypothesis rim = Proposal(scene.objects[0].solid);
  EXPECT_THAT(Verify(scene, {rim}).objects, IsEmpty());
  // With what explains the rest, it is one.
  std::vector<Hypothesis> all;
  for (const TrueObject& object : scene.objects) all.push_back(Proposal(object.solid));
  EXPECT_FALSE(Verify(scene, all).objects.empty());
}

TEST(ModelVerifier, ExtendsAHiddenBottomToTheTable) {
  const RenderedScene scene = RenderText(kBox);
  const Hypothesis upper =
      ProposalOfUpperPart(Changed(scene.objects[0].solid, {0, 0, 0.03}, {0, 0, -0.06}));
  const ObjectList list = Verify(scene, {upper});
  ASSERT_THAT(list.objects, SizeIs(1));
  EXPECT_NEAR(list.objects[0].solid.height(), 0.13, 0.003);
  EXPECT_EQ(list.objects[0].supported_by, 0);
}

TEST(ModelVerifier, FitsTheSideThatATopHasWhenItStands) {
  const RenderedScene scene =
      RenderText("object { cylinder { radius_m: 0.04 height_m: 0.15 } x_m: 0.05 y_m: 0.6 }");
  const Hypothesis top =
      ProposalOfUpperPart(Changed(scene.objects[0].solid, {0, 0, 0.0725}, {0.005, 0.005, -0.145}));
  const ObjectList list = Verify(scene, {top});
  ASSERT_THAT(list.objects, SizeIs(1));
  EXPECT_NEAR(list.objects[0].solid.radius(), 0.04, 0.001);
}

TEST(ModelVerifier, GivesAnEmptyListForAnEmptyFrame) {
  DepthFrame frame;
  frame.header.error = "no image";
  const ObjectList list = ModelVerifier(ModelVerifierConfig()).Verify(frame, HypothesisList());
  EXPECT_THAT(list.objects, IsEmpty());
  EXPECT_THAT(list.labels, IsEmpty());
  EXPECT_EQ(list.header.error, "no image");
}

std::array<Evidence, 3> EvidenceOf(const RenderedScene& scene, const Solid& solid) {
  ObservedImage observed;
  observed.Set(scene.depth, scene.table);
  const Observation observation = observed.every_pixel();
  const RayEvidence evidence = CastRays(solid, observation);
  std::vector<Eigen::Vector3d> points_O;
  FindExplainedPoints(solid, evidence, observation, &points_O);
  RayEvidence buffer;
  return ExtentEvidence(EndsOf(solid, {}, evidence, points_O, observation, &buffer));
}

TEST(ExtentEvidence, IsObservedWithFreeSpaceAroundAndNotBehindAnOccluder) {
  const RenderedScene scene = RenderText(
      "object { box { size_x_m: 0.2 size_y_m: 0.06 size_z_m: 0.12 } y_m: 0.75 }"
      "object { box { size_x_m: 0.1 size_y_m: 0.06 size_z_m: 0.3 } x_m: 0.12 y_m: 0.62 }");
  const Solid& behind = scene.objects[0].solid;
  const Solid& in_front = scene.objects[1].solid;
  EXPECT_EQ(EvidenceOf(scene, in_front)[0], Evidence::kObserved);
  EXPECT_EQ(EvidenceOf(scene, behind)[0], Evidence::kAssumed);
  EXPECT_EQ(EvidenceOf(scene, behind)[2], Evidence::kObserved);
}

TEST(ExtentEvidence, IsBoundedByFreeSpaceWhereTheOccluderEnds) {
  const RenderedScene scene = RenderText(
      "object { box { size_x_m: 0.2 size_y_m: 0.06 size_z_m: 0.12 } y_m: 0.75 }"
      "object { box { size_x_m: 0.03 size_y_m: 0.06 size_z_m: 0.2 } x_m: 0.083 y_m: 0.66 }");
  EXPECT_EQ(EvidenceOf(scene, scene.objects[0].solid)[0], Evidence::kFreeSpace);
}

TEST(ExtentEvidence, IsNotThatPointsOfAnotherFaceLieAtTheEdge) {
  const RenderedScene scene = RenderText(
      "object { box { size_x_m: 0.2 size_y_m: 0.06 size_z_m: 0.2 } x_m: 0.1 y_m: 0.75 }"
      "object { box { size_x_m: 0.14 size_y_m: 0.06 size_z_m: 0.3 } x_m: 0.0 y_m: 0.66 }");
  // Up to where it is seen from behind the other, and its left face is turned toward the camera.
  const Solid seen = Changed(scene.objects[0].solid, {0.048, 0, 0}, {-0.096, 0, 0});
  EXPECT_EQ(EvidenceOf(scene, seen)[0], Evidence::kAssumed);
}

TEST(ModelVerifier, KnowsAHiddenExtentLessWellThanASeenOne) {
  const RenderedScene scene = RenderText(
      "object { box { size_x_m: 0.2 size_y_m: 0.06 size_z_m: 0.12 } y_m: 0.75 }"
      "object { box { size_x_m: 0.1 size_y_m: 0.06 size_z_m: 0.3 } x_m: 0.12 y_m: 0.62 }");
  const ObjectList list =
      Verify(scene, {Proposal(scene.objects[0].solid), Proposal(scene.objects[1].solid)});
  ASSERT_THAT(list.objects, SizeIs(2));
  for (const ObjectModel& object : list.objects) {
    const Eigen::SelfAdjointEigenSolver<SolidCovariance> eigen(object.covariance);
    EXPECT_GE(eigen.eigenvalues().minCoeff(), -1e-12);
    EXPECT_LT(std::sqrt(object.covariance(5, 5)), 0.004);
  }
  const ObjectModel& lower = list.objects[0];  // in the order of their tops
  const ObjectModel& higher = list.objects[1];
  EXPECT_GT(std::sqrt(lower.covariance(3, 3)), 0.02);
  EXPECT_LT(std::sqrt(higher.covariance(3, 3)), 0.006);
}

TEST(ModelVerifier, KnowsACylinderBetterTheMoreOfItsSideIsSeen) {
  const std::string can = "object { cylinder { radius_m: 0.035 height_m: 0.12 } y_m: 0.7 }";
  const RenderedScene alone = RenderText(can);
  const RenderedScene hidden = RenderText(
      can + "object { box { size_x_m: 0.15 size_y_m: 0.05 size_z_m: 0.1 } x_m: -0.07 y_m: 0.6 }");
  const ObjectList seen = Verify(alone, {Proposal(alone.objects[0].solid)});
  const ObjectList half_seen =
      Verify(hidden, {Proposal(hidden.objects[0].solid), Proposal(hidden.objects[1].solid)});
  ASSERT_THAT(seen.objects, SizeIs(1));
  ASSERT_THAT(half_seen.objects, SizeIs(2));  // in the order of their tops
  EXPECT_EQ(half_seen.objects[1].solid.shape, Shape::kCylinder);
  EXPECT_LT(seen.objects[0].covariance(3, 3), half_seen.objects[1].covariance(3, 3));
  EXPECT_EQ(seen.objects[0].covariance(3, 4), seen.objects[0].covariance(3, 3));
}

TEST(Refine, BringsAnInaccurateBoxToTheTruth) {
  const RenderedScene scene = RenderText(std::string(kBox) + "noise { model: \"none\" }");
  const Solid truth = scene.objects[0].solid;
  Solid start = Changed(truth, {0.002, -0.002, 0.001}, {-0.008, 0.003, -0.002});
  start.X_CO = start.X_CO * Eigen::AngleAxisd(0.02, Eigen::Vector3d::UnitZ());
  Solid found = start;
  for (int i = 0; i < 2; ++i) found = RefineOn(scene, found);
  EXPECT_NEAR(found.size.x(), truth.size.x(), 0.002);
  EXPECT_NEAR(found.size.y(), truth.size.y(), 0.002);
  EXPECT_LT((found.X_CO.translation() - truth.X_CO.translation()).norm(), 0.003);
  EXPECT_GT(found.X_CO.linear().col(0).dot(truth.X_CO.linear().col(0)), std::cos(0.005));
}

TEST(Refine, BringsAnInaccurateCylinderToTheTruth) {
  const RenderedScene scene = RenderText(
      "object { cylinder { radius_m: 0.04 height_m: 0.15 } x_m: 0.05 y_m: 0.6 }"
      "noise { model: \"none\" }");
  const Solid truth = scene.objects[0].solid;
  const Solid start = Changed(truth, {0.002, 0.001, 0}, {0.004, 0.004, 0});
  const Solid found = RefineOn(scene, start);
  EXPECT_NEAR(found.radius(), 0.04, 0.0003);
  EXPECT_LT((found.X_CO.translation() - truth.X_CO.translation()).norm(), 0.0005);
}

TEST(Refine, LeavesASolidWithoutPointsAlone) {
  const RenderedScene scene = RenderText("");
  Solid solid;
  solid.size = Eigen::Vector3d(0.1, 0.1, 0.1);
  solid.X_CO.translation() = Eigen::Vector3d(0, 0, 0.3);
  const Solid found = RefineOn(scene, solid);
  EXPECT_EQ(found.size, solid.size);
  EXPECT_TRUE(found.X_CO.isApprox(solid.X_CO));
}

TEST(RefineIfNoWorse, KeepsASolidThatAFitWouldLeadAstray) {
  // Only a narrow strip of the cylinder's side is seen beside the box.
  const ObservedScene seen(
      "object { cylinder { radius_m: 0.03 height_m: 0.12 } x_m: 0.03 y_m: 0.7 }"
      "object { box { size_x_m: 0.2 size_y_m: 0.05 size_z_m: 0.14 } x_m: -0.06 y_m: 0.6 }");
  const Observation observation = seen.observed.every_pixel();
  const Solid truth = seen.scene.objects[0].solid;
  Solid solid = truth;
  RayEvidence evidence = CastRays(solid, observation);
  const double before = evidence.Balance();
  FitBuffers buffers;
  RefineIfNoWorse(observation, observation, &solid, &evidence, &buffers);
  EXPECT_GE(evidence.Balance(), before - 0.02 * evidence.num_explained());
  EXPECT_EQ(evidence.Balance(), CastRays(solid, observation).Balance());
  EXPECT_NEAR(solid.radius(), truth.radius(), 0.006);
}

TEST(RefineIfNoWorse, KeepsABoxOffTheTopOfItsNeighbour) {
  const ObservedScene seen(
      "object { box { size_x_m: 0.025 size_y_m: 0.05 size_z_m: 0.11 } y_m: 0.65 }"
      "object { box { size_x_m: 0.025 size_y_m: 0.05 size_z_m: 0.11 } x_m: 0.026 y_m: 0.654 }");
  const Observation observation = seen.observed.every_second_pixel();
  Solid solid = seen.scene.objects[0].solid;
  RayEvidence evidence = CastRays(solid, observation);
  FitBuffers buffers;
  EXPECT_GT(Refine(solid, observation, &buffers.points).size.x(), 0.045);
  RefineIfNoWorse(observation, observation, &solid, &evidence, &buffers);
  EXPECT_NEAR(solid.size.x(), 0.025, 0.003);
}

TEST(RefineOrClimb, BringsBackACylinderThatAFitMadeTooLarge) {
  // The sensor bends what is seen of the side.
  const ObservedScene seen(
      "object { cylinder { radius_m: 0.022 height_m: 0.102 } y_m: 0.699 }"
      "object { box { size_x_m: 0.099 size_y_m: 0.04 size_z_m: 0.08 } x_m: -0.069 y_m: 0.64 }");
  const Observation observation = seen.observed.every_second_pixel();
  Solid solid = Changed(seen.scene.objects[0].solid, {0, 0, 0}, {0.003, 0.003, 0});
  RayEvidence evidence = CastRays(solid, observation);
  FitBuffers buffers;
  EXPECT_GT(Refine(solid, observation, &buffers.points).radius(), 0.025);
  EXPECT_TRUE(RefineOrClimb(observation, observation, &solid, &evidence, &buffers).is_fitted);
  EXPECT_NEAR(solid.radius(), 0.022, 0.001);
  EXPECT_EQ(evidence.Balance(), CastRays(solid, observation).Balance());
}

TEST(ClimbCylinder, FindsACylinderByItsTopWhereItsSideIsHidden) {
  const ObservedScene seen(
      "object { cylinder { radius_m: 0.04 height_m: 0.12 } y_m: 0.7 }"
      "object { box { size_x_m: 0.2 size_y_m: 0.05 size_z_m: 0.133 } y_m: 0.62 }");
  const Observation observation = seen.observed.every_pixel();
  const Solid truth = seen.scene.objects[0].solid;
  Solid solid = Changed(truth, {0.003, -0.002, 0}, {0.008, 0.008, 0});
  RayEvidence evidence = CastRays(solid, observation);
  RayEvidence buffer;
  ClimbCylinder(observation, &solid, &evidence, &buffer);
  EXPECT_NEAR(solid.radius(), truth.radius(), 0.002);
  EXPECT_LT((solid.X_CO.translation() - truth.X_CO.translation()).norm(), 0.003);
  EXPECT_EQ(evidence.Balance(), CastRays(solid, observation).Balance());
}

}  // namespace
}  // namespace declutter
