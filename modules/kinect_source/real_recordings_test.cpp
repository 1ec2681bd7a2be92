#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "modules/imaging/png_file.h"
#include "modules/kinect_source/point_clouds.h"
#include "modules/kinect_source/recording_reader.h"

namespace declutter {
namespace {

// Reads the recordings in the folder $DECLUTTER_DATA: scene folders, and in pcd/ clouds of some of
// the same frames.
class RealRecordingsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* data = std::getenv("DECLUTTER_DATA");
    if (data == nullptr) GTEST_SKIP() << "DECLUTTER_DATA is not set: no real recordings to read";
    data_ = data;
  }

  void ExpectSameDepth(const std::string& cloud, const std::string& intrinsics,
                       const std::string& scene) {
    const auto content = ListPointClouds(data_ + "/pcd/" + cloud, intrinsics).at(0).load();
    const auto depth = imaging::ReadGray16Png(data_ + "/" + scene + "/depth.png");
    const auto color = imaging::ReadRgbPng(data_ + "/" + scene + "/rgb.png");
    EXPECT_EQ(content.depth.depth_scale_m, 0.001);
    EXPECT_NEAR(content.depth.camera.fx, 525, 0.01);
    EXPECT_NEAR(content.depth.camera.cx, 319.5, 0.01);
    EXPECT_TRUE(content.depth.counts == depth.pixels);
    EXPECT_TRUE(content.color && content.color->rgb == color.rgb);
  }

  std::string data_;
};

TEST_F(RealRecordingsTest, EverySceneIsReadable) {
  KinectSourceConfig config;
  config.set_input(data_);
  RecordingReader reader(config);
  while (const auto frame = reader.Next()) {
    const auto& [header, image, X_WC, decimation] = frame->depth;
    EXPECT_FALSE(decimation.has_value());
    EXPECT_EQ(header.error, "") << header.frame;
    EXPECT_GT(std::count_if(image.counts.begin(), image.counts.end(), [](int c) { return c > 0; }),
              image.camera.num_pixels() / 4)
        << header.frame;
    EXPECT_TRUE(frame->color) << header.frame << frame->color_error;
  }
}

TEST_F(RealRecordingsTest, OrganisedCloudGivesTheDepthImageItWasMadeFrom) {
  ExpectSameDepth("mosd_learn33_organised_label.pcd", "", "mosd/learn33");
}

TEST_F(RealRecordingsTest, UnorganisedCloudGivesTheDepthImageByReprojection) {
  ExpectSameDepth("mosd_test43_unorganised_label.pcd", data_ + "/mosd/test43/scene.json",
                  "mosd/test43");
}

TEST_F(RealRecordingsTest, RecoversTheCameraOfAStereoCloud) {
  const auto content =
      ListPointClouds(data_ + "/pcd/pcl_table_mug_stereo_organised.pcd", "").at(0).load();
  EXPECT_NEAR(content.depth.camera.fx, 964.36, 0.01);
  EXPECT_NEAR(content.depth.camera.fy, 964.36, 0.01);
  EXPECT_NEAR(content.depth.camera.cx, 319.8, 0.05);
  EXPECT_NEAR(content.depth.camera.cy, 223.4, 0.05);
}

}  // namespace
}  // namespace declutter
