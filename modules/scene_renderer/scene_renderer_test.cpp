#include "modules/scene_renderer/scene_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "modules/imaging/png_file.h"
#include "modules/scene_renderer/scene_folder.h"
#include "modules/scene_renderer/scene_text.h"

namespace declutter {
namespace {

Scene Load(const std::string& path) {
  std::ifstream file(std::string(SCENE_DIR) + "/" + path);
  std::ostringstream text;
  text << file.rdbuf();
  return ParseScene(text.str(), path);
}

RenderedScene RenderExactly(const std::string& name) {
  Scene scene = Load("tests/data/scenes/" + name + ".textproto");
  scene.mutable_noise()->set_model("none");
  return Render(scene, 1);
}

double HighestAbove(const Plane& table, const RenderedScene& rendered, uint8_t label) {
  double highest = -1;
  for (int v = 0; v < rendered.depth.camera.height; ++v) {
    for (int u = 0; u < rendered.depth.camera.width; ++u) {
      if (rendered.labels[static_cast<size_t>(v * rendered.depth.camera.width + u)] != label)
        continue;
      highest = std::max(highest, table.Height(rendered.depth.PointAt(u, v)));
    }
  }
  return highest;
}

TEST(SceneRendererTest, TablePixelsLieOnTheTablePlane) {
  const RenderedScene rendered = RenderExactly("empty_table");
  int num_table = 0;
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      if (rendered.labels[static_cast<size_t>(v * 640 + u)] != kTableLabel) continue;
      ++num_table;
      ASSERT_NEAR(rendered.table.Height(rendered.depth.PointAt(u, v)), 0, 0.0006);
    }
  }
  EXPECT_GT(num_table, 200000);
  EXPECT_TRUE(rendered.objects.empty());
}

TEST(SceneRendererTest, BoxStandsOnTheTableAtItsStatedPlace) {
  const RenderedScene rendered = RenderExactly("single_box");
  const TrueObject& box = rendered.objects.at(0);
  const Eigen::Vector3d p_WO = rendered.X_WC * box.solid.X_CO.translation();
  EXPECT_TRUE(p_WO.isApprox(Eigen::Vector3d(0.02, 0.65, 0.1), 1e-9));
  EXPECT_TRUE(box.solid.size.isApprox(Eigen::Vector3d(0.16, 0.06, 0.2)));
  EXPECT_TRUE((box.solid.X_CO.linear().col(2)).isApprox(rendered.table.normal, 1e-9));
  EXPECT_EQ(box.label, 20);
  EXPECT_EQ(box.visible_fraction(), 1);
  EXPECT_NEAR(HighestAbove(rendered.table, rendered, box.label), 0.2, 0.001);
}

TEST(SceneRendererTest, SeedPixelHasTheObjectsLabel) {
  const RenderedScene rendered = RenderExactly("ten_small_objects");
  ASSERT_EQ(rendered.objects.size(), 10U);
  for (const TrueObject& object : rendered.objects) {
    EXPECT_EQ(rendered.labels[static_cast<size_t>(object.seed_px[1] * 640 + object.seed_px[0])],
              object.label);
    EXPECT_GT(object.num_px, 300);
  }
}

TEST(SceneRendererTest, StackedCanRestsOnItsBox) {
  const RenderedScene rendered = RenderExactly("can_on_box");
  EXPECT_EQ(rendered.objects.at(1).rests_on, rendered.objects.at(0).id);
  EXPECT_EQ(rendered.objects.at(0).rests_on, 0);
  EXPECT_NEAR(HighestAbove(rendered.table, rendered, rendered.objects.at(1).label), 0.17, 0.001);
}

TEST(SceneRendererTest, HiddenPartIsMissingFromTheVisibleFraction) {
  const RenderedScene rendered = RenderExactly("cylinder_behind_box");
  const TrueObject& cylinder = rendered.objects.at(1);
  EXPECT_GT(cylinder.visible_fraction(), 0.3);
  EXPECT_LT(cylinder.visible_fraction(), 0.8);
  EXPECT_EQ(cylinder.num_px, cylinder.num_visible_px);
}

TEST(SceneRendererTest, TouchingBoxesShareAnOutline) {
  const RenderedScene rendered = RenderExactly("two_touching_boxes");
  int num_adjacent = 0;
  for (size_t i = 1; i < rendered.labels.size(); ++i) {
    num_adjacent += rendered.labels[i - 1] == 20 && rendered.labels[i] == 30 ? 1 : 0;
  }
  EXPECT_GT(num_adjacent, 30);
}

TEST(SceneRendererTest, RoomHasDepthBeyondTheTableWithoutLabel) {
  const RenderedScene rendered = RenderExactly("room");
  int num_beyond = 0;
  for (size_t i = 0; i < rendered.labels.size(); ++i) {
    num_beyond += rendered.labels[i] == 0 && rendered.depth.counts[i] > 1500 ? 1 : 0;
  }
  EXPECT_GT(num_beyond, 60000);
  EXPECT_EQ(std::count(rendered.depth.counts.begin(), rendered.depth.counts.end(), 0), 0);
}

TEST(SceneRendererTest, OnlyPixelsWithDepthHaveALabel) {
  const RenderedScene rendered = Render(Load("tests/data/scenes/single_box.textproto"), 1);
  int num_missing = 0;
  for (size_t i = 0; i < rendered.labels.size(); ++i) {
    if (rendered.depth.counts[i] != 0) continue;
    ++num_missing;
    ASSERT_EQ(rendered.labels[i], 0);
  }
  EXPECT_GT(num_missing, 1000);
}

TEST(SceneRendererTest, LabelsOfAllIdsDifferAndKeepClearOfTheTables) {
  std::vector<uint8_t> labels;
  for (int id = kFirstObjectId; id < kFirstObjectId + kMaxObjects; ++id) {
    labels.push_back(LabelOf(id));
  }
  EXPECT_EQ(labels[0], 20);
  EXPECT_EQ(labels[23], 250);
  EXPECT_EQ(labels[24], 21);
  EXPECT_GE(*std::min_element(labels.begin(), labels.end()), 20);
  std::sort(labels.begin(), labels.end());
  EXPECT_EQ(std::adjacent_find(labels.begin(), labels.end()), labels.end());
  EXPECT_THROW(LabelOf(kFirstObjectId + kMaxObjects), std::invalid_argument);
}

TEST(SceneRendererTest, DemoSceneHasSeventeenObjectsInViewInDenseClutter) {
  const RenderedScene rendered = Render(Load("config/scenes/demo.textproto"), 1);
  ASSERT_EQ(rendered.objects.size(), 17U);
  int num_cylinders = 0, num_half_hidden = 0;
  for (const TrueObject& object : rendered.objects) {
    EXPECT_GE(object.num_visible_px, 500) << "object " << object.id;
    num_cylinders += object.solid.shape == Shape::kCylinder ? 1 : 0;
    num_half_hidden += object.visible_fraction() < 0.5 ? 1 : 0;
  }
  EXPECT_EQ(num_cylinders, 6);
  EXPECT_GE(num_half_hidden, 4);
}

TEST(SceneRendererTest, RenderedSceneWithoutChanceRendersToTheSameImages) {
  const RenderedScene rendered = Render(Load("config/scenes/dense.textproto"), 7);
  const RenderedScene again = Render(ParseScene(PrintScene(rendered.scene), "again"), 7);
  EXPECT_EQ(rendered.depth.counts, again.depth.counts);
  EXPECT_EQ(rendered.labels, again.labels);
  EXPECT_EQ(rendered.color.rgb, again.color.rgb);
}

TEST(SceneRendererTest, WritesAFolderThatStatesImagesAndTruth) {
  const RenderedScene rendered = RenderExactly("can_on_box");
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / "scene_renderer_test";
  WriteSceneFolder(rendered, "can_on_box", folder.string());
  EXPECT_EQ(imaging::ReadGray16Png((folder / "depth.png").string()).pixels, rendered.depth.counts);
  EXPECT_EQ(imaging::ReadGray8Png((folder / "labels.png").string()).pixels, rendered.labels);
  EXPECT_EQ(imaging::ReadRgbPng((folder / "rgb.png").string()).rgb, rendered.color.rgb);
  std::ifstream file(folder / "scene.json");
  const nlohmann::json scene = nlohmann::json::parse(file);
  EXPECT_EQ(scene["fx"], 525);
  EXPECT_EQ(scene["table_plane"]["d"], rendered.table.d);
  const nlohmann::json& box = scene["objects"][0];
  const nlohmann::json& can = scene["objects"][1];
  EXPECT_EQ(box["known_size"]["dims"], nlohmann::json({0.2, 0.14, 0.06}));
  EXPECT_EQ(box["truth"]["rests_on"], "table");
  EXPECT_EQ(can["truth"]["rests_on"], 2);
  EXPECT_EQ(can["labels"], nlohmann::json({30}));
  EXPECT_EQ(can["scope"], "core");
  EXPECT_NEAR(can["truth"]["height"], 0.11, 1e-12);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace declutter
