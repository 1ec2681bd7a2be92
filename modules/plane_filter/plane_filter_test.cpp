#include "modules/plane_filter/plane_filter.h"

#include <gmock/gmock.h>
#include <google/protobuf/text_format.h>

#include <algorithm>
#include <cmath>

#include "modules/scene_renderer/scene_renderer.h"

namespace declutter {
namespace {

using ::testing::Each;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr char kBoxAndCan[] =
    "object { box { size_x_m: 0.2 size_y_m: 0.08 size_z_m: 0.15 } x_m: -0.15 y_m: 0.7 } "
    "object { cylinder { radius_m: 0.04 height_m: 0.12 } x_m: 0.1 y_m: 0.6 } ";

RenderedScene RenderText(const std::string& text) {
  Scene scene;
  EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(text, &scene)) << text;
  return Render(scene, 1);
}

Tabletop Filter(const DepthImage& image) {
  DepthFrame frame;
  frame.header.utime = 7;
  frame.image = image;
  return PlaneFilter(PlaneFilterConfig()).Filter(frame);
}

double AngleDegrees(const Plane& a, const Plane& b) {
  return std::acos(std::min(1.0, a.normal.dot(b.normal))) * 180 / M_PI;
}

void ExpectMainSupport(const Tabletop& tabletop, const Plane& table) {
  ASSERT_FALSE(tabletop.planes.empty());
  // The sensor's waviness alone tilts a small table by half a degree.
  EXPECT_LT(AngleDegrees(tabletop.planes[0].plane, table), 0.8);
  EXPECT_NEAR(tabletop.planes[0].plane.d, table.d, 0.008);
}

// Part of the pixels with depth and a label in [first, last] that were kept.
double PartKept(const Tabletop& tabletop, const RenderedScene& scene, int first, int last) {
  int num_pixels = 0;
  int num_kept = 0;
  for (size_t i = 0; i < scene.labels.size(); ++i) {
    if (scene.depth.counts[i] == 0 || scene.labels[i] < first || scene.labels[i] > last) continue;
    ++num_pixels;
    num_kept += tabletop.objects.counts[i] > 0;
  }
  EXPECT_GT(num_pixels, 0);
  return static_cast<double>(num_kept) / num_pixels;
}

constexpr int kFirstObject = 20;
constexpr int kLastLabel = 255;

TEST(PlaneFilterTest, FindsTheTableUnderClutterAndKeepsWhatStandsOnIt) {
  const RenderedScene scene = RenderText("clutter {}");
  const Tabletop tabletop = Filter(scene.depth);
  ExpectMainSupport(tabletop, scene.table);
  EXPECT_GT(PartKept(tabletop, scene, kFirstObject, kLastLabel), 0.97);
  EXPECT_LT(PartKept(tabletop, scene, kTableLabel, kTableLabel), 0.01);
}

// An empty table far away, part of which is off by so many standard deviations of 1 / z.
DepthImage WavyTable(float sigmas) {
  DepthImage image = RenderText(
                         "camera { height_m: 1 pitch_rad: 0.9 } noise { model: \"none\" } "
                         "table { size_x_m: 2 size_y_m: 2 y_m: 0.9 }")
                         .depth;
  const double sigma = PlaneFilterConfig().inverse_depth_sigma();
  for (int v = 200; v < 260; ++v) {
    for (int u = 280; u < 360; ++u) {
      uint16_t& count = image.counts[static_cast<size_t>(v * image.camera.width + u)];
      const double z = 1 / (1 / (count * image.depth_scale_m) + sigmas * sigma);
      count = static_cast<uint16_t>(std::lround(z / image.depth_scale_m));
    }
  }
  return image;
}

TEST(PlaneFilterTest, TakesNoWaveOfAFarTableForAnObject) {
  EXPECT_EQ(Filter(WavyTable(4.5f)).num_object_points, 0);
  EXPECT_GT(Filter(WavyTable(7)).num_object_points, 3000);
}

TEST(PlaneFilterTest, FindsTheTableForACameraThatHangsUpsideDown) {
  // The face of the large box looks upward in the image, and something stands before it.
  const RenderedScene scene = RenderText(
      "camera { roll_rad: 3.1416 pitch_rad: 0.8 } "
      "table { size_x_m: 0.5 size_y_m: 0.5 y_m: 0.65 } "
      "object { box { size_x_m: 0.3 size_y_m: 0.08 size_z_m: 0.25 } y_m: 0.72 } "
      "object { box { size_x_m: 0.12 size_y_m: 0.06 size_z_m: 0.1 } y_m: 0.55 yaw_rad: 0.3 } ");
  const Tabletop tabletop = Filter(scene.depth);
  ExpectMainSupport(tabletop, scene.table);
  EXPECT_GT(PartKept(tabletop, scene, kFirstObject, kLastLabel), 0.95);
}

TEST(PlaneFilterTest, FindsTheTableInTheNoiseOfASensorTooNearForIt) {
  const RenderedScene scene = RenderText(
      "camera { height_m: 0.42 pitch_rad: 0.8 } "
      "noise { model: \"white\" white_sigma_m: 0.004 } "
      "object { box { size_x_m: 0.1 size_y_m: 0.08 size_z_m: 0.12 } y_m: 0.42 }");
  const Tabletop tabletop = Filter(scene.depth);
  ExpectMainSupport(tabletop, scene.table);
  EXPECT_GT(PartKept(tabletop, scene, kFirstObject, kLastLabel), 0.9);
  EXPECT_LT(PartKept(tabletop, scene, kTableLabel, kTableLabel), 0.01);
}

TEST(PlaneFilterTest, KeepsTheCountsOfObjectPixels) {
  const RenderedScene scene = RenderText(kBoxAndCan);
  const Tabletop tabletop = Filter(scene.depth);
  int num_kept = 0;
  for (size_t i = 0; i < scene.depth.counts.size(); ++i) {
    const uint16_t count = tabletop.objects.counts[i];
    num_kept += count > 0;
    ASSERT_TRUE(count == 0 || count == scene.depth.counts[i]);
  }
  EXPECT_EQ(num_kept, tabletop.num_object_points);
  EXPECT_EQ(tabletop.thinning, 1);
  EXPECT_EQ(tabletop.header.utime, 7);
}

TEST(PlaneFilterTest, PrefersASmallTableToTheFloorAndTheWallsAroundIt) {
  const RenderedScene scene = RenderText(
      std::string(kBoxAndCan) +
      "table { size_x_m: 0.7 size_y_m: 0.5 y_m: 0.65 } camera { height_m: 0.8 pitch_rad: 0.7 } "
      "room { floor_depth_m: 0.7 wall { distance_m: 1.8 } wall { distance_m: 1 heading_rad: 1.4 } "
      "}");
  const Tabletop tabletop = Filter(scene.depth);
  ExpectMainSupport(tabletop, scene.table);
  EXPECT_GT(PartKept(tabletop, scene, kFirstObject, kLastLabel), 0.97);
  EXPECT_LT(PartKept(tabletop, scene, 0, kTableLabel), 0.01);
  // The floor is listed after the table.
  ASSERT_THAT(tabletop.planes, SizeIs(2));
  EXPECT_NEAR(tabletop.planes[1].plane.d - tabletop.planes[0].plane.d, 0.7, 0.02);
}

TEST(PlaneFilterTest, PrefersALowTableToALargerFloor) {
  const RenderedScene scene = RenderText(
      "camera { height_m: 0.98 pitch_rad: 0.71 } table { size_x_m: 0.6 size_y_m: 0.55 y_m: 1.14 } "
      "room { floor_depth_m: 0.49 } "
      "object { cylinder { radius_m: 0.04 height_m: 0.15 } x_m: -0.12 y_m: 1.26 } "
      "object { cylinder { radius_m: 0.06 height_m: 0.17 } x_m: 0.12 y_m: 1.25 }");
  const Tabletop tabletop = Filter(scene.depth);
  ExpectMainSupport(tabletop, scene.table);
  EXPECT_GT(PartKept(tabletop, scene, kFirstObject, kLastLabel), 0.95);
  EXPECT_LT(PartKept(tabletop, scene, 0, kTableLabel), 0.01);
}

TEST(PlaneFilterTest, DropsAWallAtTheBorderOfTheTable) {
  const RenderedScene scene =
      RenderText(std::string(kBoxAndCan) + "room { wall { distance_m: 1.31 } }");
  const Tabletop tabletop = Filter(scene.depth);
  ExpectMainSupport(tabletop, scene.table);
  EXPECT_GT(PartKept(tabletop, scene, kFirstObject, kLastLabel), 0.97);
  EXPECT_LT(PartKept(tabletop, scene, 0, 0), 0.01);
}

TEST(PlaneFilterTest, KeepsABoxAtTheFarBorderOfTheTable) {
  const RenderedScene scene = RenderText(
      "table { size_x_m: 0.6 size_y_m: 0.5 y_m: 0.65 } "
      "object { box { size_x_m: 0.3 size_y_m: 0.08 size_z_m: 0.2 } y_m: 0.86 }");
  EXPECT_GT(PartKept(Filter(scene.depth), scene, kFirstObject, kLastLabel), 0.97);
}

TEST(PlaneFilterTest, TopsOfLargeBoxesAreNoSupports) {
  const RenderedScene scene = RenderText(
      "object { box { size_x_m: 0.4 size_y_m: 0.3 size_z_m: 0.1 } y_m: 0.65 } "
      "object { cylinder { radius_m: 0.04 height_m: 0.1 } y_m: 0.65 on: 0 }");
  const Tabletop tabletop = Filter(scene.depth);
  ExpectMainSupport(tabletop, scene.table);
  EXPECT_THAT(tabletop.planes, SizeIs(1));
  EXPECT_GT(PartKept(tabletop, scene, kFirstObject, kLastLabel), 0.97);
}

TEST(PlaneFilterTest, TopsOfTallBoxesMakeNoFloorOfTheTable) {
  const RenderedScene scene = RenderText(
      "camera { height_m: 0.75 } "
      "object { box { size_x_m: 0.35 size_y_m: 0.3 size_z_m: 0.2 } x_m: 0.1 y_m: 0.65 } "
      "object { box { size_x_m: 0.2 size_y_m: 0.2 size_z_m: 0.32 } x_m: -0.2 y_m: 0.5 } "
      "object { cylinder { radius_m: 0.1 height_m: 0.25 } x_m: 0.1 y_m: 0.65 on: 0 }");
  const Tabletop tabletop = Filter(scene.depth);
  ExpectMainSupport(tabletop, scene.table);
  EXPECT_GT(PartKept(tabletop, scene, kFirstObject, kLastLabel), 0.97);
}

TEST(PlaneFilterTest, WorksForACameraThatLooksStraightDown) {
  const RenderedScene scene = RenderText(
      "camera { height_m: 0.9 pitch_rad: 1.57 } table { y_m: 0 } "
      "object { box { size_x_m: 0.2 size_y_m: 0.08 size_z_m: 0.1 } y_m: 0 } room { floor_depth_m: "
      "0.7 }");
  const Tabletop tabletop = Filter(scene.depth);
  ExpectMainSupport(tabletop, scene.table);
  EXPECT_GT(PartKept(tabletop, scene, kFirstObject, kLastLabel), 0.97);
}

TEST(PlaneFilterTest, WorksForACameraOnItsSide) {
  const RenderedScene scene = RenderText(std::string(kBoxAndCan) + "camera { roll_rad: 1.5708 }");
  ExpectMainSupport(Filter(scene.depth), scene.table);
}

TEST(PlaneFilterTest, HullIsCounterClockwiseInThePlane) {
  const Tabletop tabletop = Filter(RenderText(kBoxAndCan).depth);
  const auto& [plane, hull] = tabletop.planes.at(0);
  ASSERT_GE(hull.size(), 3u);
  for (size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector3d a = hull[i].cast<double>();
    const Eigen::Vector3d b = hull[(i + 1) % hull.size()].cast<double>();
    const Eigen::Vector3d c = hull[(i + 2) % hull.size()].cast<double>();
    EXPECT_NEAR(plane.Height(a), 0, 1e-5);
    EXPECT_GT((b - a).cross(c - b).dot(plane.normal), 0);
  }
}

TEST(PlaneFilterTest, ABareTableHasASupportAndNoObjects) {
  const RenderedScene scene = RenderText("noise { model: 'white' }");
  const Tabletop tabletop = Filter(scene.depth);
  ExpectMainSupport(tabletop, scene.table);
  EXPECT_EQ(tabletop.num_object_points, 0);
}

TEST(PlaneFilterTest, TheSameFrameGivesTheSameTabletop) {
  const DepthImage image = RenderText("clutter {}").depth;
  const Tabletop first = Filter(image);
  const Tabletop second = Filter(image);
  ASSERT_EQ(first.planes.size(), second.planes.size());
  EXPECT_EQ(first.planes[0].plane.normal, second.planes[0].plane.normal);
  EXPECT_EQ(first.planes[0].hull, second.planes[0].hull);
  EXPECT_TRUE(first.objects.counts == second.objects.counts);
}

void ExpectSame(const Tabletop& tabletop, const Tabletop& expected) {
  EXPECT_EQ(tabletop.num_object_points, expected.num_object_points);
  EXPECT_TRUE(tabletop.objects.counts == expected.objects.counts);
  ASSERT_EQ(tabletop.planes.size(), expected.planes.size());
  for (size_t i = 0; i < expected.planes.size(); ++i) {
    EXPECT_EQ(tabletop.planes[i].plane.normal, expected.planes[i].plane.normal);
    EXPECT_EQ(tabletop.planes[i].hull, expected.planes[i].hull);
  }
}

TEST(PlaneFilterTest, NothingIsLeftOfTheFramesBefore) {
  const std::string small = "camera { width: 320 height: 240 fx: 262 fy: 262 } ";
  DepthFrame bare;
  bare.image = RenderText("noise { model: 'none' }").depth;
  std::fill(bare.image.counts.begin(), bare.image.counts.end(), uint16_t{0});
  std::vector<DepthFrame> frames(5, bare);
  frames[0].image = RenderText("clutter {}").depth;
  frames[1].image = RenderText(small + kBoxAndCan + "room { floor_depth_m: 0.7 }").depth;
  frames[3].image =
      RenderText(std::string(kBoxAndCan) + "room { wall { distance_m: 1.31 } }").depth;
  frames[4].header.error = "no image";
  PlaneFilter filter{PlaneFilterConfig()};
  for (const size_t i : {0, 1, 0, 2, 3, 0, 4, 1, 3, 2}) {
    SCOPED_TRACE(i);
    ExpectSame(filter.Filter(frames[i]), PlaneFilter(PlaneFilterConfig()).Filter(frames[i]));
  }
}

TEST(PlaneFilterTest, AnotherSeedMovesThePlaneByLessThanItsAccuracy) {
  DepthFrame frame;
  frame.image = RenderText("clutter {}").depth;
  PlaneFilterConfig config;
  const Plane first = PlaneFilter(config).Filter(frame).planes.at(0).plane;
  for (uint64_t seed = 2; seed < 6; ++seed) {
    config.set_seed(seed);
    const Plane plane = PlaneFilter(config).Filter(frame).planes.at(0).plane;
    EXPECT_LT(AngleDegrees(plane, first), 0.05) << seed;
    EXPECT_NEAR(plane.d, first.d, 0.0005) << seed;
  }
}

TEST(PlaneFilterTest, AFrameWithAnErrorGivesAnEmptyTabletopWithItsHeader) {
  DepthFrame frame;
  frame.header = {5, "scene", "cannot read depth.png"};
  const Tabletop tabletop = PlaneFilter(PlaneFilterConfig()).Filter(frame);
  EXPECT_EQ(tabletop.header.utime, 5);
  EXPECT_EQ(tabletop.header.frame, "scene");
  EXPECT_EQ(tabletop.header.error, "cannot read depth.png");
  EXPECT_THAT(tabletop.planes, IsEmpty());
  EXPECT_THAT(tabletop.objects.counts, IsEmpty());
}

TEST(PlaneFilterTest, AFrameWithoutMeasurementsGivesAnEmptyTabletop) {
  DepthImage image = RenderText("noise { model: 'none' }").depth;
  std::fill(image.counts.begin(), image.counts.end(), uint16_t{0});
  const Tabletop tabletop = Filter(image);
  EXPECT_THAT(tabletop.planes, IsEmpty());
  EXPECT_EQ(tabletop.num_object_points, 0);
  EXPECT_EQ(tabletop.objects.camera.width, 640);
  EXPECT_THAT(tabletop.objects.counts, SizeIs(640 * 480));
  EXPECT_THAT(tabletop.objects.counts, Each(0));
}

TEST(PlaneFilterTest, AFrameWithoutAPlaneGivesAnEmptyTabletop) {
  DepthImage image = RenderText("noise { model: 'none' }").depth;
  for (size_t i = 0; i < image.counts.size(); ++i) {
    image.counts[i] = static_cast<uint16_t>(400 + i * 7919 % 5003);
  }
  const Tabletop tabletop = Filter(image);
  EXPECT_THAT(tabletop.planes, IsEmpty());
  EXPECT_EQ(tabletop.num_object_points, 0);
}

TEST(PlaneFilterTest, TinyImagesAreNoFault) {
  for (int size = 1; size < 20; ++size) {
    DepthImage image;
    image.camera = {size, size, 500, 500, 0, 0};
    image.counts.assign(static_cast<size_t>(size * size), 800);
    EXPECT_EQ(Filter(image).num_object_points, 0) << size;
  }
}

}  // namespace
}  // namespace declutter
