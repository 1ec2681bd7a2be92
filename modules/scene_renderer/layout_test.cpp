#include "modules/scene_renderer/layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "modules/scene_renderer/scene_text.h"

namespace declutter {
namespace {

using ::testing::HasSubstr;

std::string FaultOf(const std::string& text) {
  try {
    PlaceObjects(ParseScene(text, "scene"));
  } catch (const std::invalid_argument& fault) {
    return fault.what();
  }
  return "";
}

TEST(LayoutTest, StandsAnObjectOnTheTopOfAnother) {
  const auto objects = PlaceObjects(ParseScene(R"(
    object { box { size_x_m: 0.2 size_y_m: 0.2 size_z_m: 0.07 } support_height_m: 0.01 }
    object { cylinder { radius_m: 0.03 height_m: 0.1 } on: 0 })",
                                               "scene"));
  EXPECT_DOUBLE_EQ(objects[1].bottom_m, 0.08);
  EXPECT_EQ(objects[1].on, 0);
  EXPECT_EQ(objects[0].on, -1);
}

TEST(LayoutTest, AcceptsFacesThatTouchAndRefusesObjectsThatOverlap) {
  EXPECT_EQ(FaultOf("object { box {} x_m: 0 } object { box {} x_m: 0.1 }"), "");
  EXPECT_THAT(FaultOf("object { box {} x_m: 0 } object { box {} x_m: 0.095 }"),
              HasSubstr("object 1 cuts 5"));
}

TEST(LayoutTest, RefusesASupportThatIsNotListedBefore) {
  EXPECT_THAT(FaultOf("object { box {} on: 1 } object { box {} }"),
              HasSubstr("object 0 stands on object 1"));
}

TEST(LayoutTest, RefusesAnObjectWithoutShape) {
  EXPECT_THAT(FaultOf("object { x_m: 0.1 }"), HasSubstr("object 0 is neither"));
}

TEST(LayoutTest, CameraLooksDownByItsPitch) {
  SceneCamera camera;
  camera.set_height_m(0.6);
  camera.set_pitch_rad(0.5);
  const Eigen::Isometry3d X_WC = CameraPose(camera);
  EXPECT_TRUE(X_WC.translation().isApprox(Eigen::Vector3d(0, 0, 0.6)));
  const Eigen::Vector3d forward(0, std::cos(0.5), -std::sin(0.5));
  EXPECT_TRUE((X_WC.linear() * Eigen::Vector3d::UnitZ()).isApprox(forward));
  EXPECT_TRUE((X_WC.linear() * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_NEAR(X_WC.linear().determinant(), 1, 1e-12);
}

TEST(LayoutTest, StatedObjectsReadBackAsTheyWerePlaced) {
  const Scene scene = ParseScene(R"(
    object { box { size_x_m: 0.2 size_y_m: 0.1 size_z_m: 0.07 } x_m: 0.1 y_m: 0.6 yaw_rad: 0.3 }
    object { cylinder { radius_m: 0.03 height_m: 0.1 } x_m: 0.1 y_m: 0.6 on: 0 })",
                                 "scene");
  const auto objects = PlaceObjects(scene);
  for (int i = 0; i < 2; ++i) {
    SceneObject stated = ToSceneObject(objects[static_cast<size_t>(i)]);
    stated.clear_color();
    if (i == 1) stated.clear_yaw_rad();
    EXPECT_EQ(stated.DebugString(), scene.object(i).DebugString());
  }
}

}  // namespace
}  // namespace declutter
