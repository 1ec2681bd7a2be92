#include "modules/scene_renderer/scene_text.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace declutter {
namespace {

std::string FaultOf(const std::string& text) {
  try {
    ParseScene(text, "a.textproto");
  } catch (const std::invalid_argument& fault) {
    return fault.what();
  }
  return "";
}

TEST(SceneTextTest, ReadsAScene) {
  const Scene scene = ParseScene("object { cylinder { radius_m: 0.05 } x_m: 0.1 }", "scene");
  EXPECT_EQ(scene.object(0).cylinder().radius_m(), 0.05);
  EXPECT_EQ(scene.camera().fx(), 525);
}

TEST(SceneTextTest, NamesThePlaceOfAnUnknownField) {
  EXPECT_EQ(FaultOf("camera {\n  hight_m: 1\n}").rfind("a.textproto:2:", 0), 0U);
}

TEST(SceneTextTest, NamesEveryValueOutsideItsRange) {
  EXPECT_EQ(FaultOf("object {\n  box { size_x_m: -1 }\n}\nnoise { hole_fraction: nan }"),
            "a.textproto:4:9: hole_fraction = nan outside [0, 1]\n"
            "a.textproto:2:9: size_x_m = -1 outside [0.001, 5] m");
}

TEST(SceneTextTest, NamesTheModelsOfNoiseThereAre) {
  EXPECT_EQ(FaultOf("noise { model: \"pink\" }"),
            "a.textproto:1:9: model = \"pink\" is none of \"real_sensor\" \"white\" \"none\"");
}

TEST(SceneTextTest, NamesThePlaceOfAnObjectThatCannotBePutDown) {
  EXPECT_EQ(FaultOf("object { box {} }\n  object { box {} on: 4 }"),
            "a.textproto:2:3: object 1 stands on object 4, which is not listed before it");
}

TEST(SceneTextTest, PrintedSceneReadsBackEqual) {
  const Scene scene = ParseScene("object { box {} x_m: 0.12345678901 } clutter { seed: 3 }", "");
  EXPECT_EQ(ParseScene(PrintScene(scene), "").SerializeAsString(), scene.SerializeAsString());
}

}  // namespace
}  // namespace declutter
