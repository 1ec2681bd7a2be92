#include "tests/accuracy/matching.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace declutter::accuracy {
namespace {

using ::testing::HasSubstr;
using ::testing::Optional;

constexpr int kWidth = 40;
constexpr int kHeight = 10;

// Fills columns [begin, end) of a label image.
void Fill(std::vector<uint8_t>* labels, int begin, int end, uint8_t value) {
  labels->resize(kWidth * kHeight);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = begin; u < end; ++u) (*labels)[static_cast<size_t>(v * kWidth + u)] = value;
  }
}

// A table seen from straight above, up toward the camera.
SceneTruth EmptyTable() {
  SceneTruth truth;
  truth.up_C = {0, 0, -1};
  truth.width = kWidth;
  truth.height = kHeight;
  return truth;
}

TrueObject Object(const std::string& shape, Stance stance, Scope scope) {
  TrueObject object;
  object.name = "thing";
  object.shape_name = shape;
  if (shape == "box") object.shape = Shape::kBox;
  if (shape == "cylinder") object.shape = Shape::kCylinder;
  object.stance = stance;
  object.scope = scope;
  return object;
}

// A labelled true object that covers columns [begin, end).
void AddObject(SceneTruth* truth, TrueObject object, int begin, int end) {
  object.id = static_cast<int>(truth->objects.size()) + 2;
  object.labels = {10 * object.id};
  Fill(&truth->labels, begin, end, static_cast<uint8_t>(10 * object.id));
  truth->objects.push_back(object);
}

// An unlabelled one with its seed in the column.
void AddSeed(SceneTruth* truth, TrueObject object, int column) {
  object.seed_px = {column, 5};
  truth->objects.push_back(object);
}

// A model, turned about x, that covers columns [begin, end).
void AddModel(ObjectList* found, Shape shape, int begin, int end, double tilt_rad = 0) {
  ObjectModel model;
  model.id = static_cast<int>(found->objects.size()) + 1;
  model.solid.shape = shape;
  model.solid.size = {0.1, 0.1, 0.1};
  model.solid.X_CO.translation() << 0.05 * (begin + end), 0, 1;
  model.solid.X_CO.rotate(Eigen::AngleAxisd(tilt_rad, Eigen::Vector3d::UnitX()));
  found->camera.width = kWidth;
  found->camera.height = kHeight;
  Fill(&found->labels, begin, end, static_cast<uint8_t>(model.id));
  found->objects.push_back(model);
}

TEST(MatchObjects, FindsAnObjectHalfCoveredByAModelOfItsShape) {
  SceneTruth truth = EmptyTable();
  AddObject(&truth, Object("box", Stance::kStanding, Scope::kCore), 0, 20);
  ObjectList found;
  AddModel(&found, Shape::kBox, 0, 10);
  const FrameScore score = MatchObjects(truth, found);
  EXPECT_THAT(score.objects[0].model, Optional(0u));
  EXPECT_DOUBLE_EQ(score.objects[0].iou, 0.5);
  EXPECT_EQ(score.models[0].verdict, Verdict::kRight);
}

TEST(MatchObjects, MissesAnObjectLessThanHalfCoveredAndSaysByHowMuch) {
  SceneTruth truth = EmptyTable();
  AddObject(&truth, Object("box", Stance::kStanding, Scope::kCore), 0, 20);
  ObjectList found;
  AddModel(&found, Shape::kBox, 0, 9);
  const FrameScore score = MatchObjects(truth, found);
  EXPECT_FALSE(score.objects[0].model);
  EXPECT_THAT(score.objects[0].why, HasSubstr("best IoU 0.45 with model 1 box"));
  EXPECT_EQ(score.models[0].verdict, Verdict::kFalse);
}

TEST(MatchObjects, CallsAModelOfTheWrongShapeFalse) {
  SceneTruth truth = EmptyTable();
  AddObject(&truth, Object("box", Stance::kStanding, Scope::kCore), 0, 20);
  ObjectList found;
  AddModel(&found, Shape::kCylinder, 0, 20);
  const FrameScore score = MatchObjects(truth, found);
  EXPECT_FALSE(score.objects[0].model);
  EXPECT_EQ(score.models[0].verdict, Verdict::kFalse);
  EXPECT_THAT(score.models[0].why, HasSubstr("wrong shape"));
}

TEST(MatchObjects, CallsALyingModelOfAnUprightCylinderFalse) {
  SceneTruth truth = EmptyTable();
  AddObject(&truth, Object("cylinder", Stance::kStanding, Scope::kCore), 0, 20);
  ObjectList found;
  AddModel(&found, Shape::kCylinder, 0, 20, M_PI / 2);
  const FrameScore score = MatchObjects(truth, found);
  EXPECT_FALSE(score.objects[0].model);
  EXPECT_EQ(score.models[0].verdict, Verdict::kFalse);
}

TEST(MatchObjects, GivesAnObjectToItsBestModelAndCallsTheOtherADouble) {
  SceneTruth truth = EmptyTable();
  AddObject(&truth, Object("box", Stance::kStanding, Scope::kCore), 0, 30);
  ObjectList found;
  AddModel(&found, Shape::kBox, 0, 10);
  AddModel(&found, Shape::kBox, 10, 30);
  const FrameScore score = MatchObjects(truth, found);
  EXPECT_THAT(score.objects[0].model, Optional(1u));
  EXPECT_EQ(score.models[0].verdict, Verdict::kFalse);
  EXPECT_THAT(score.models[0].why, HasSubstr("double of model 2"));
}

TEST(MatchObjects, CallsAModelOfTheTableFalse) {
  SceneTruth truth = EmptyTable();
  AddObject(&truth, Object("box", Stance::kStanding, Scope::kCore), 0, 4);
  ObjectList found;
  AddModel(&found, Shape::kBox, 2, 10);
  EXPECT_EQ(MatchObjects(truth, found).models[0].verdict, Verdict::kFalse);
}

TEST(MatchObjects, CallsAModelWithoutPixelsFalse) {
  SceneTruth truth = EmptyTable();
  AddObject(&truth, Object("box", Stance::kStanding, Scope::kCore), 0, 4);
  ObjectList found;
  AddModel(&found, Shape::kBox, 0, 0);
  EXPECT_EQ(MatchObjects(truth, found).models[0].verdict, Verdict::kFalse);
}

TEST(MatchObjects, CountsModelsOfSoftObjectsNeitherWay) {
  SceneTruth truth = EmptyTable();
  AddObject(&truth, Object("box", Stance::kStanding, Scope::kSoft), 0, 10);
  AddObject(&truth, Object("prism", Stance::kLying, Scope::kSoft), 10, 20);
  ObjectList found;
  AddModel(&found, Shape::kBox, 0, 10);
  AddModel(&found, Shape::kCylinder, 10, 20);
  const FrameScore score = MatchObjects(truth, found);
  EXPECT_THAT(score.objects[0].model, Optional(0u));
  EXPECT_EQ(score.models[0].verdict, Verdict::kNeutral);
  EXPECT_EQ(score.models[1].verdict, Verdict::kNeutral);
}

TEST(MatchObjects, CountsModelsOfUnscoredObjectsNeitherWay) {
  SceneTruth truth = EmptyTable();
  AddObject(&truth, Object("box", Stance::kStanding, Scope::kUnscored), 0, 10);
  ObjectList found;
  AddModel(&found, Shape::kBox, 0, 10);
  const FrameScore score = MatchObjects(truth, found);
  EXPECT_FALSE(score.objects[0].model);
  EXPECT_EQ(score.models[0].verdict, Verdict::kNeutral);
}

TEST(MatchObjects, CallsAnUprightModelOfAnOutObjectFalse) {
  SceneTruth truth = EmptyTable();
  AddObject(&truth, Object("other", Stance::kUnknown, Scope::kOut), 0, 10);
  AddObject(&truth, Object("cylinder", Stance::kLying, Scope::kOut), 10, 20);
  AddObject(&truth, Object("box", Stance::kLeaning, Scope::kOut), 20, 30);
  ObjectList found;
  AddModel(&found, Shape::kCylinder, 0, 10);
  AddModel(&found, Shape::kCylinder, 10, 20);
  AddModel(&found, Shape::kBox, 20, 30);
  for (const ModelScore& model : MatchObjects(truth, found).models) {
    EXPECT_EQ(model.verdict, Verdict::kFalse) << model.why;
  }
}

TEST(MatchObjects, AllowsAnOutObjectModelledAsWhatItIs) {
  SceneTruth truth = EmptyTable();
  AddObject(&truth, Object("cylinder", Stance::kLying, Scope::kOut), 10, 20);
  AddObject(&truth, Object("box", Stance::kLeaning, Scope::kOut), 20, 30);
  AddObject(&truth, Object("other", Stance::kUnknown, Scope::kOut), 30, 40);
  ObjectList found;
  AddModel(&found, Shape::kCylinder, 10, 20, 1.5);
  AddModel(&found, Shape::kBox, 20, 30, 0.3);
  AddModel(&found, Shape::kCylinder, 30, 40, 1.5);
  for (const ModelScore& model : MatchObjects(truth, found).models) {
    EXPECT_EQ(model.verdict, Verdict::kNeutral) << model.why;
  }
}

TEST(MatchObjects, FindsAnUnlabelledObjectWhoseSeedIsThreePixelsFromItsModel) {
  SceneTruth truth = EmptyTable();
  AddSeed(&truth, Object("cylinder", Stance::kStanding, Scope::kCore), 7);
  ObjectList found;
  AddModel(&found, Shape::kCylinder, 10, 20);
  EXPECT_THAT(MatchObjects(truth, found).objects[0].model, Optional(0u));
}

TEST(MatchObjects, MissesAnUnlabelledObjectWhoseSeedIsFourPixelsFromItsModel) {
  SceneTruth truth = EmptyTable();
  AddSeed(&truth, Object("cylinder", Stance::kStanding, Scope::kCore), 6);
  ObjectList found;
  AddModel(&found, Shape::kCylinder, 10, 20);
  const FrameScore score = MatchObjects(truth, found);
  EXPECT_FALSE(score.objects[0].model);
  EXPECT_EQ(score.models[0].verdict, Verdict::kNeutral);
}

TEST(MatchObjects, CallsAModelAtAnUnlabelledSeedOfAnotherShapeFalse) {
  SceneTruth truth = EmptyTable();
  AddSeed(&truth, Object("cylinder", Stance::kStanding, Scope::kCore), 5);
  AddSeed(&truth, Object("other", Stance::kStanding, Scope::kOut), 25);
  ObjectList found;
  AddModel(&found, Shape::kBox, 0, 10);
  AddModel(&found, Shape::kCylinder, 20, 30);
  const FrameScore score = MatchObjects(truth, found);
  EXPECT_EQ(score.models[0].verdict, Verdict::kFalse);
  EXPECT_EQ(score.models[1].verdict, Verdict::kFalse);
}

TEST(MatchObjects, CallsAModelInsideTheMatchOfAnUnlabelledObjectADouble) {
  SceneTruth truth = EmptyTable();
  AddSeed(&truth, Object("box", Stance::kStanding, Scope::kCore), 5);
  ObjectList found;
  AddModel(&found, Shape::kBox, 0, 10);
  AddModel(&found, Shape::kBox, 10, 20);
  found.objects[1].solid.X_CO = found.objects[0].solid.X_CO;
  found.objects[1].solid.size *= 0.5;
  const FrameScore score = MatchObjects(truth, found);
  EXPECT_EQ(score.models[0].verdict, Verdict::kRight);
  EXPECT_EQ(score.models[1].verdict, Verdict::kFalse);
}

TEST(MatchObjects, RefusesLabelImagesOfDifferentSizes) {
  SceneTruth truth = EmptyTable();
  AddObject(&truth, Object("box", Stance::kStanding, Scope::kCore), 0, 20);
  ObjectList found;
  AddModel(&found, Shape::kBox, 0, 10);
  found.labels.resize(100);
  EXPECT_THROW(MatchObjects(truth, found), std::runtime_error);
}

}  // namespace
}  // namespace declutter::accuracy
