#include "modules/scene_renderer/clutter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "modules/scene_renderer/scene_text.h"

namespace declutter {
namespace {

using ::testing::HasSubstr;

class DenseClutterTest : public ::testing::TestWithParam<uint64_t> {
 protected:
  const Scene scene_ = ParseScene("clutter {}", "scene");
  const std::vector<PlacedObject> objects_ = AddClutter(scene_, GetParam(), {});
};

TEST_P(DenseClutterTest, HasElevenBoxesAndSixCylinders) {
  EXPECT_EQ(objects_.size(), 17U);
  EXPECT_EQ(std::count_if(objects_.begin(), objects_.end(),
                          [](const PlacedObject& o) { return o.shape == Shape::kBox; }),
            11);
}

TEST_P(DenseClutterTest, KeepsTheLimitsOfDenseClutter) {
  const ClutterFigures figures = Measure(scene_, objects_);
  EXPECT_GE(figures.num_touching_pairs, 5);
  EXPECT_EQ(figures.num_stacked, 2);
  EXPECT_GE(figures.num_half_hidden, 4);
  EXPECT_LE(figures.median_gap_m, 0.010);
  EXPECT_GE(*std::min_element(figures.visible_px.begin(), figures.visible_px.end()), 300);
}

TEST_P(DenseClutterTest, NothingOverlapsAndStackedObjectsStandWithinWhatCarriesThem) {
  for (size_t i = 0; i < objects_.size(); ++i) {
    for (size_t other = 0; other < i; ++other) {
      if (!ShareHeights(objects_[i], objects_[other])) continue;
      EXPECT_GT(Gap(objects_[i].footprint, objects_[other].footprint), 0);
    }
    if (objects_[i].on < 0) {
      EXPECT_EQ(objects_[i].bottom_m, 0);
      continue;
    }
    const PlacedObject& support = objects_[static_cast<size_t>(objects_[i].on)];
    EXPECT_DOUBLE_EQ(objects_[i].bottom_m, support.bottom_m + support.height_m);
    EXPECT_TRUE(Contains(support.footprint, objects_[i].footprint, 0));
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, DenseClutterTest, ::testing::Range<uint64_t>(1, 9));

TEST(ClutterTest, SameSeedGivesTheSameLayoutAndAnotherSeedAnother) {
  const Scene scene = ParseScene(
      "clutter { num_boxes: 4 num_cylinders: 2 min_touching_pairs: 2 min_half_hidden: 0 }", "");
  const auto first = AddClutter(scene, 3, {});
  const auto again = AddClutter(scene, 3, {});
  const auto other = AddClutter(scene, 4, {});
  for (size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].footprint.centre, again[i].footprint.centre);
  }
  EXPECT_NE(first.back().footprint.centre, other.back().footprint.centre);
}

TEST(ClutterTest, KeepsTheObjectsTheSceneStates) {
  const Scene scene = ParseScene(R"(
    object { box {} y_m: 0.65 }
    clutter { num_boxes: 2 num_cylinders: 1 min_touching_pairs: 2 num_stacked: 1 min_half_hidden: 0 })",
                                 "");
  const auto fixed = PlaceObjects(scene);
  const auto objects = AddClutter(scene, 1, fixed);
  ASSERT_EQ(objects.size(), 4U);
  EXPECT_EQ(objects[0].footprint.centre, fixed[0].footprint.centre);
}

TEST(ClutterTest, SaysWhatIsMissingWhenItGivesUp) {
  const Scene scene = ParseScene(
      "clutter { num_boxes: 2 num_cylinders: 0 num_stacked: 0 min_touching_pairs: 3 max_moves: 50 "
      "}",
      "");
  try {
    AddClutter(scene, 1, {});
    FAIL() << "two boxes cannot touch three times";
  } catch (const std::invalid_argument& fault) {
    EXPECT_THAT(fault.what(), HasSubstr("of 3 touching pairs"));
  }
}

TEST(ClutterTest, GivesUpWhenThereIsNoRoom) {
  const Scene scene =
      ParseScene("clutter { num_boxes: 30 extent_x_m: 0.2 extent_y_m: 0.2 max_moves: 100 }", "");
  EXPECT_THROW(AddClutter(scene, 1, {}), std::invalid_argument);
}

}  // namespace
}  // namespace declutter
