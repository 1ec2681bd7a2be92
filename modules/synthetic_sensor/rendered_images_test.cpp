#include "modules/synthetic_sensor/rendered_images.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "modules/imaging/temporary_folder.h"
#include "modules/scene_renderer/scene_renderer.h"
#include "modules/scene_renderer/scene_text.h"

namespace declutter {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Counts 0 1 2 3 / 10 11 12 13.
DepthImage Image4x2() { return {{4, 2}, 0.001, {0, 1, 2, 3, 10, 11, 12, 13}}; }

std::vector<uint16_t> Seen(const ImageWindow& window) {
  std::vector<uint16_t> counts(static_cast<size_t>(window.width * window.height));
  CopyDepth(Image4x2(), window, counts.data());
  return counts;
}

TEST(ImageWindowTest, ShowsTheWholeImage) {
  EXPECT_EQ(Seen({1, false, 0, 0, 4, 2}), Image4x2().counts);
}

TEST(ImageWindowTest, ShowsAPart) {
  EXPECT_THAT(Seen({1, false, 1, 1, 2, 1}), ElementsAre(11, 12));
}

TEST(ImageWindowTest, ShowsEverySecondPixel) {
  EXPECT_THAT(Seen({2, false, 0, 0, 2, 1}), ElementsAre(0, 2));
}

TEST(ImageWindowTest, ShowsAMirroredImageAndItsPart) {
  EXPECT_THAT(Seen({1, true, 0, 0, 4, 1}), ElementsAre(3, 2, 1, 0));
  EXPECT_THAT(Seen({1, true, 1, 0, 2, 1}), ElementsAre(2, 1));
}

TEST(ImageWindowTest, ShowsColourLikeDepth) {
  const ColorImage image{2, 1, {1, 2, 3, 4, 5, 6}};
  std::vector<uint8_t> rgb(6);
  CopyColor(image, {1, true, 0, 0, 2, 1}, rgb.data());
  EXPECT_THAT(rgb, ElementsAre(4, 5, 6, 1, 2, 3));
}

class RenderedImagesTest : public testing::Test {
 protected:
  void WriteScene(const std::string& text) { std::ofstream(folder_ / "scene.textproto") << text; }

  RenderedImages Render() const {
    SyntheticSensor sensor;
    sensor.set_scene("scene.textproto");
    sensor.set_seed(7);
    sensor.set_num_images(2);
    return RenderImages(sensor, folder_ / "sensor.textproto");
  }

  imaging::TemporaryFolder folder_;
};

TEST_F(RenderedImagesTest, AreThoseOfTheRenderer) {
  const std::string scene = "camera { width: 64 height: 48 fx: 52 fy: 52 cx: 31.5 cy: 23.5 }";
  WriteScene(scene);
  const RenderedImages images = Render();
  ASSERT_EQ(images.depth.size(), 2u);
  for (uint64_t i = 0; i < 2; ++i) {
    const RenderedScene expected = declutter::Render(ParseScene(scene, "scene"), 7, i);
    EXPECT_EQ(images.depth[i].counts, expected.depth.counts);
    EXPECT_EQ(images.color.rgb, expected.color.rgb);
  }
  EXPECT_NE(images.depth[0].counts, images.depth[1].counts);
}

TEST_F(RenderedImagesTest, SayWhatIsWrongWithTheScene) {
  WriteScene("table { size_x_m: -1 }");
  try {
    Render();
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("scene.textproto:1:9: size_x_m = -1 outside"));
  }
}

}  // namespace
}  // namespace declutter
