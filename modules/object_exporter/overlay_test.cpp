#include "modules/object_exporter/overlay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "modules/object_exporter/object_tags.h"

namespace declutter {
namespace {

constexpr PinholeCamera kCamera = {320, 240, 250, 250, 159.5, 119.5};

// A box of 0.2 m in the middle of the image, its front face 0.9 m away: 55 px wide.
ObjectList OneBox() {
  ObjectList list;
  list.camera = kCamera;
  list.labels.assign(320 * 240, 0);
  ObjectModel box;
  box.id = 1;
  box.solid.X_CO.translation() = Eigen::Vector3d(0, 0, 1);
  box.solid.size = Eigen::Vector3d(0.2, 0.2, 0.2);
  list.objects = {box};
  return list;
}

DepthImage Wall(uint16_t count) {
  return {kCamera, 0.001, std::vector<uint16_t>(320 * 240, count)};
}

imaging::Rgb At(const ColorImage& image, int u, int v) {
  const size_t first = 3 * static_cast<size_t>(v * image.width + u);
  return {image.rgb[first], image.rgb[first + 1], image.rgb[first + 2]};
}

constexpr int kLeftEdge = 132;  // u of the box's front left edge

TEST(OverlayTest, DrawsVisibleEdgesInTheColourOfTheObject) {
  const ColorImage overlay = DrawOverlay(OneBox(), nullptr, nullptr);
  EXPECT_EQ(overlay.width, 320);
  EXPECT_EQ(overlay.height, 240);
  int num_bright = 0;
  for (int v = 100; v < 140; ++v) {
    for (int u = kLeftEdge - 1; u <= kLeftEdge + 1; ++u) num_bright += At(overlay, u, v)[0] > 120;
  }
  EXPECT_GE(num_bright, 40);
}

TEST(OverlayTest, DrawsEdgesBehindSomethingFainter) {
  const DepthImage behind = Wall(1500);
  const DepthImage before = Wall(500);
  const auto brightness = [](const ColorImage& overlay) {
    int sum = 0;
    for (int u = kLeftEdge - 2; u <= kLeftEdge + 2; ++u) {
      sum += At(overlay, u, 130)[0] - At(overlay, u, 130)[1];
    }
    return sum;
  };
  const int seen = brightness(DrawOverlay(OneBox(), &behind, nullptr));
  const int hidden = brightness(DrawOverlay(OneBox(), &before, nullptr));
  EXPECT_GT(hidden, 0);
  EXPECT_GT(seen, 3 * hidden / 2);
}

TEST(OverlayTest, TintsThePixelsOfAnObject) {
  ObjectList list;
  list.camera = kCamera;
  list.labels.assign(320 * 240, 0);
  for (int v = 200; v < 210; ++v) {
    for (int u = 200; u < 210; ++u) list.labels[static_cast<size_t>(v * 320 + u)] = 2;
  }
  const ColorImage grey{320, 240, std::vector<uint8_t>(3 * 320 * 240, 100)};
  const ColorImage overlay = DrawOverlay(list, nullptr, &grey);
  EXPECT_EQ(At(overlay, 150, 150), (imaging::Rgb{100, 100, 100}));
  const auto inside = At(overlay, 205, 205);
  const auto rim = At(overlay, 200, 205);
  EXPECT_GT(inside[2], 100);
  EXPECT_GT(rim[2], inside[2]);
}

TEST(OverlayTest, GivesEveryObjectItsOwnColour) {
  for (int id = 1; id <= 12; ++id) {
    for (int other = 1; other < id; ++other) EXPECT_NE(ColorOf(id), ColorOf(other));
  }
  EXPECT_EQ(ColorOf(13), ColorOf(1));
}

TEST(OverlayTest, ShowsDepthAsGreyWithoutColour) {
  ObjectList list = OneBox();
  list.objects.clear();
  DepthImage depth = Wall(2000);
  for (size_t i = 0; i < depth.counts.size() / 2; ++i) depth.counts[i] = 800;
  depth.counts[0] = 0;
  const ColorImage overlay = DrawOverlay(list, &depth, nullptr);
  EXPECT_GT(At(overlay, 5, 5)[0], At(overlay, 5, 235)[0]);
  EXPECT_GT(At(overlay, 5, 235)[0], 0);
  EXPECT_EQ(At(overlay, 0, 0), (imaging::Rgb{0, 0, 0}));
}

TEST(OverlayTest, DoesNotUseImagesOfAnotherSize) {
  ObjectList list = OneBox();
  list.objects.clear();
  const ColorImage small{2, 2, std::vector<uint8_t>(12, 200)};
  const DepthImage short_depth{{2, 2, 1, 1, 0, 0}, 0.001, {1, 2, 3, 4}};
  EXPECT_THAT(DrawOverlay(list, &short_depth, &small).rgb, ::testing::Each(0));
}

TEST(OverlayTest, TagsOfNeighboursDoNotCoverEachOther) {
  ObjectList list = OneBox();
  list.objects.push_back(list.objects[0]);
  list.objects[1].id = 2;
  const ColorImage overlay = DrawOverlay(list, nullptr, nullptr);
  // The bar of a tag is as high as the tag; each colour has one of its own.
  const auto num_full = [&](int id) {
    int num = 0;
    for (int v = 0; v < 240; ++v) {
      for (int u = 0; u < 160; ++u) num += At(overlay, u, v) == ColorOf(id);
    }
    return num;
  };
  EXPECT_GE(num_full(1), 2 * 17);
  EXPECT_GE(num_full(2), 2 * 17);
}

TEST(OverlayTest, SurvivesSolidsAroundTheCamera) {
  ObjectList list = OneBox();
  list.objects[0].solid.X_CO.translation() = Eigen::Vector3d(0, 0, 0.01);
  EXPECT_EQ(DrawOverlay(list, nullptr, nullptr).width, 320);
  list.objects[0].solid.shape = Shape::kCylinder;
  EXPECT_EQ(DrawOverlay(list, nullptr, nullptr).width, 320);
}

TEST(OverlayTest, SurvivesAnImageSmallerThanATag) {
  ObjectList list = OneBox();
  list.camera = {16, 12, 10, 10, 8, 6};
  list.labels.assign(16 * 12, 1);
  EXPECT_EQ(DrawOverlay(list, nullptr, nullptr).rgb.size(), 3u * 16 * 12);
}

}  // namespace
}  // namespace declutter
