#include "modules/kinect_source/recording_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "modules/imaging/temporary_folder.h"
#include "modules/kinect_source/recording_files.h"

namespace declutter {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class RecordingReaderTest : public ::testing::Test {
 protected:
  std::vector<RecordedFrame> ReadAll(const std::string& input) {
    config_.set_input(input);
    RecordingReader reader(config_);
    std::vector<RecordedFrame> frames;
    while (auto frame = reader.Next()) frames.push_back(*frame);
    return frames;
  }

  std::vector<std::string> NamesIn(const std::string& input) {
    std::vector<std::string> names;
    for (const auto& frame : ReadAll(input)) names.push_back(frame.depth.header.frame);
    return names;
  }

  // The error of the only frame.
  std::string ErrorIn(const std::string& input) {
    const auto frames = ReadAll(input);
    EXPECT_EQ(frames.size(), 1u);
    EXPECT_TRUE(frames.at(0).depth.image.empty());
    return frames.at(0).depth.header.error;
  }

  std::string RefusalOf(const std::string& input) {
    config_.set_input(input);
    try {
      RecordingReader reader(config_);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "not refused";
  }

  imaging::TemporaryFolder folder_;
  KinectSourceConfig config_;
};

TEST_F(RecordingReaderTest, ReadsAScene) {
  WriteScene(folder_.path() / "mug", 700);
  WriteColor3x2(folder_.path() / "mug/rgb.png", 50);
  const auto frames = ReadAll(folder_ / "mug");
  ASSERT_EQ(frames.size(), 1u);
  const DepthFrame& depth = frames[0].depth;
  EXPECT_EQ(depth.header.frame, "mug");
  EXPECT_EQ(depth.header.error, "");
  EXPECT_EQ(depth.image.camera.width, 3);
  EXPECT_EQ(depth.image.camera.fy, 501);
  EXPECT_EQ(depth.image.depth_scale_m, 0.001);
  EXPECT_THAT(depth.image.counts, Each(700));
  ASSERT_TRUE(frames[0].color);
  EXPECT_EQ(frames[0].color->rgb[0], 50);
}

TEST_F(RecordingReaderTest, NamesASceneAfterItsFolderHoweverItIsWritten) {
  WriteScene(folder_.path() / "mug", 700);
  EXPECT_THAT(NamesIn(folder_ / "mug/"), ElementsAre("mug"));
  EXPECT_THAT(NamesIn(folder_ / "mug/../mug/."), ElementsAre("mug"));
}

TEST_F(RecordingReaderTest, FindsScenesInByteOrderOfTheirPaths) {
  for (const char* name : {"b", "a/z", "a-b", "B/x/y", "a/10", "a/9"}) {
    WriteScene(folder_.path() / name, 700);
  }
  EXPECT_THAT(NamesIn(folder_ / ""), ElementsAre("B_x_y", "a-b", "a_10", "a_9", "a_z", "b"));
}

TEST_F(RecordingReaderTest, SpacesScenesByOneThirtiethOfASecond) {
  WriteScene(folder_.path() / "a", 700);
  WriteScene(folder_.path() / "b", 700);
  const auto frames = ReadAll(folder_ / "");
  EXPECT_EQ(frames.at(0).depth.header.utime, 0);
  EXPECT_EQ(frames.at(1).depth.header.utime, 33333);
}

TEST_F(RecordingReaderTest, FollowsLinksButNotInCircles) {
  WriteScene(folder_.path() / "data/a", 700);
  std::filesystem::create_directories(folder_.path() / "links");
  std::filesystem::create_symlink(folder_.path() / "data", folder_.path() / "links/data");
  std::filesystem::create_symlink(folder_.path() / "links", folder_.path() / "links/circle");
  EXPECT_THAT(NamesIn(folder_ / "links"), ElementsAre("data_a"));
}

TEST_F(RecordingReaderTest, GoesOnAfterAnUnreadableScene) {
  WriteScene(folder_.path() / "a", 700);
  WriteScene(folder_.path() / "b", 700);
  WriteScene(folder_.path() / "c", 700);
  std::filesystem::resize_file(folder_.path() / "b/depth.png", 60);
  const auto frames = ReadAll(folder_ / "");
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames[1].depth.header.frame, "b");
  EXPECT_EQ(frames[1].depth.header.utime, 33333);
  EXPECT_EQ(frames[1].depth.header.error, "b/depth.png: truncated PNG");
  EXPECT_TRUE(frames[1].depth.image.empty());
  EXPECT_EQ(frames[2].depth.header.error, "");
}

TEST_F(RecordingReaderTest, NamesASingleUnreadableFileWithoutItsFolder) {
  WriteText(folder_.path() / "cloud.pcd", "");
  EXPECT_EQ(ErrorIn(folder_ / "cloud.pcd"), "cloud.pcd: not a .pcd file: it has no DATA line");
}

TEST_F(RecordingReaderTest, ReportsASceneWithoutItsFiles) {
  WriteDepth3x2(folder_.path() / "a/depth.png", 700);
  EXPECT_EQ(ErrorIn(folder_ / "a"), "scene.json: No such file or directory");
  WriteText(folder_.path() / "b/scene.json", kCamera3x2);
  EXPECT_EQ(ErrorIn(folder_ / "b"), "depth.png: No such file or directory");
}

TEST_F(RecordingReaderTest, ReportsASceneWithoutTheDepthFileThatIsAskedFor) {
  WriteScene(folder_.path() / "a", 700);
  config_.set_depth_file("depth_uncropped.png");
  EXPECT_EQ(ErrorIn(folder_ / "a"), "depth_uncropped.png: No such file or directory");
  WriteDepth3x2(folder_.path() / "a/depth_uncropped.png", 900);
  EXPECT_THAT(ReadAll(folder_ / "a").at(0).depth.image.counts, Each(900));
}

TEST_F(RecordingReaderTest, ReportsAnImageOfAnotherSizeThanTheIntrinsics) {
  WriteScene(folder_.path() / "a", 700);
  imaging::WriteGray16Png(folder_ / "a/depth.png", {2, 2, {1, 2, 3, 4}});
  EXPECT_EQ(ErrorIn(folder_ / "a"), "depth.png: 2 x 2 px, but the intrinsics are for 3 x 2 px");
}

TEST_F(RecordingReaderTest, ReportsAnImageThatIsNot16BitGrey) {
  WriteScene(folder_.path() / "a", 700);
  imaging::WriteGray8Png(folder_ / "a/depth.png", {3, 2, {1, 2, 3, 4, 5, 6}});
  EXPECT_EQ(ErrorIn(folder_ / "a"), "depth.png: 8-bit grey PNG where 16-bit grey is needed");
}

TEST_F(RecordingReaderTest, ReportsWhatIsWrongInSceneJson) {
  WriteScene(folder_.path() / "a", 700);
  const auto error_for = [&](const std::string& json) {
    WriteText(folder_.path() / "a/scene.json", json);
    return ErrorIn(folder_ / "a");
  };
  EXPECT_THAT(error_for(""), HasSubstr("scene.json: not JSON"));
  EXPECT_THAT(error_for("{\"width\": 3,"),
              HasSubstr("scene.json: not JSON: parse error at line 1"));
  EXPECT_EQ(error_for("[1]"), "scene.json: not a JSON object");
  EXPECT_EQ(error_for("{}"), "scene.json: width is missing");
  EXPECT_EQ(error_for(R"({"width": "3"})"), "scene.json: width is not a number");
  EXPECT_EQ(error_for(R"({"width": 2.5})"), "scene.json: width is not a whole number");
  EXPECT_EQ(error_for(R"({"width": -3})"), "scene.json: width = -3 outside [1, 4096]");
  EXPECT_EQ(error_for(R"({"width": 3, "height": 2, "fx": 0, "fy": 1, "cx": 0, "cy": 0})"),
            "scene.json: fx = 0 outside [1, 1e+06]");
  EXPECT_EQ(error_for(R"({"width": 3, "height": 2, "fx": 1, "fy": 1, "cx": 1, "cy": 1})"),
            "scene.json: depth_scale_m is missing");
  const std::string camera = R"({"width": 3, "height": 2, "fx": 1, "fy": 1, "cx": 1, "cy": 1, )";
  EXPECT_EQ(error_for(camera + R"("depth_scale_m": -0.001})"),
            "scene.json: depth_scale_m = -0.001 outside [1e-06, 1]");
  EXPECT_THAT(error_for(camera + R"("depth_scale_m": NaN})"), HasSubstr("scene.json: not JSON"));
}

TEST_F(RecordingReaderTest, ReportsAFolderInPlaceOfAFile) {
  WriteScene(folder_.path() / "a", 700);
  std::filesystem::remove(folder_.path() / "a/scene.json");
  std::filesystem::create_directory(folder_.path() / "a/scene.json");
  EXPECT_EQ(ErrorIn(folder_ / "a"), "scene.json: Is a directory");
}

TEST_F(RecordingReaderTest, TakesADepthImageWithoutMeasurements) {
  WriteScene(folder_.path() / "a", 0);
  const auto frames = ReadAll(folder_ / "a");
  EXPECT_EQ(frames.at(0).depth.header.error, "");
  EXPECT_THAT(frames.at(0).depth.image.counts, ElementsAre(0, 0, 0, 0, 0, 0));
}

TEST_F(RecordingReaderTest, KeepsTheDepthWhenTheColourIsUnusable) {
  WriteScene(folder_.path() / "a", 700);
  imaging::WriteRgbPng(folder_ / "a/rgb.png", {1, 1, {1, 2, 3}});
  const auto frames = ReadAll(folder_ / "a");
  EXPECT_THAT(frames.at(0).depth.image.counts, Each(700));
  EXPECT_FALSE(frames.at(0).color);
  EXPECT_EQ(frames.at(0).color_error, "rgb.png: 1 x 1 px, but the depth image has 3 x 2 px");
}

TEST_F(RecordingReaderTest, RefusesAnInputWithNothingToRead) {
  EXPECT_EQ(RefusalOf(folder_ / "none"), (folder_ / "none") + ": no such file or folder");
  WriteText(folder_.path() / "notes/readme.txt", "nothing here");
  EXPECT_THAT(RefusalOf(folder_ / "notes"), HasSubstr("notes: nothing to read"));
  EXPECT_THAT(RefusalOf(folder_ / "notes/readme.txt"), HasSubstr("nothing to read"));
}

TEST_F(RecordingReaderTest, PlacesTheCameraInTheWorld) {
  WriteScene(folder_.path() / "a", 700);
  config_.set_camera_z_m(1.5);
  config_.set_camera_qw(std::sqrt(0.5));
  config_.set_camera_qx(-std::sqrt(0.5));
  const Eigen::Isometry3d X_WC = ReadAll(folder_ / "a").at(0).depth.X_WC;
  EXPECT_TRUE((X_WC * Eigen::Vector3d(0, 0, 2)).isApprox(Eigen::Vector3d(0, 2, 1.5), 1e-12));
}

TEST_F(RecordingReaderTest, RefusesAQuaternionThatIsNotOfUnitLength) {
  WriteScene(folder_.path() / "a", 700);
  config_.set_camera_qw(0);
  EXPECT_THAT(RefusalOf(folder_ / "a"), HasSubstr("camera_qw"));
}

TEST_F(RecordingReaderTest, TimeGoesOnInALoop) {
  WriteScene(folder_.path() / "a", 700);
  WriteScene(folder_.path() / "b", 700);
  config_.set_input(folder_ / "");
  config_.set_loop(true);
  RecordingReader reader(config_);
  for (int i = 0; i < 5; ++i) {
    const auto frame = reader.Next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->depth.header.frame, i % 2 == 0 ? "a" : "b");
    EXPECT_EQ(frame->depth.header.utime, i * 33333);
  }
}

}  // namespace
}  // namespace declutter
