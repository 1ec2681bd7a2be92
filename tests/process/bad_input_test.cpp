#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "modules/imaging/png_file.h"
#include "tests/process/graph_run.h"

namespace declutter {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::SizeIs;

constexpr const char* kCamera =
    R"({"width": 640, "height": 480, "fx": 525, "fy": 525, "cx": 319.5, "cy": 239.5)";
const std::string kCameraAndScale = std::string(kCamera) + R"(, "depth_scale_m": 0.001})";

imaging::GrayImage<uint16_t> Uniform(int width, int height, uint16_t count) {
  return {width, height, std::vector<uint16_t>(static_cast<size_t>(width * height), count)};
}

// No coder can make this smaller.
imaging::GrayImage<uint16_t> Noise(int width, int height) {
  imaging::GrayImage<uint16_t> image = Uniform(width, height, 0);
  std::mt19937 random(1);
  for (uint16_t& count : image.pixels) count = static_cast<uint16_t>(random());
  return image;
}

// What no graph can see through, met by a user who runs it over a folder.
class BadInputTest : public GraphRun {
 protected:
  // A scene of this scene.json and depth image, at scenes/name.
  std::string WriteScene(const std::string& name, const std::string& scene_json,
                         const imaging::GrayImage<uint16_t>& depth) const {
    const std::string scene = scenes_ + "/" + name;
    fs::create_directories(scene);
    if (!scene_json.empty()) folder_.Write("scenes/" + name + "/scene.json", scene_json);
    imaging::WriteGray16Png(scene + "/depth.png", depth);
    return scene;
  }

  // The only scene's line has this error and so has stderr; the run ends with 1.
  void ExpectError(const std::string& scene, const std::string& error) {
    const Outcome outcome = Run(scene, output_);
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    const std::string frame = fs::path(scene).filename();
    EXPECT_THAT(outcome.err, HasSubstr("kinect_source: " + frame + ": " + error));
    const std::vector<json> lines = Lines(output_);
    ASSERT_THAT(lines, SizeIs(1));
    EXPECT_EQ(lines[0].at("frame"), frame);
    EXPECT_THAT(lines[0].at("error").get<std::string>(), HasSubstr(error));
    EXPECT_THAT(lines[0].at("planes"), IsEmpty());
    EXPECT_THAT(lines[0].at("objects"), IsEmpty());
    EXPECT_FALSE(fs::exists(output_ + "/" + frame + ".labels.png"));
  }

  // The only scene's line has no object and no error; the run ends with 0.
  void ExpectNothingFound(const std::string& scene) {
    const Outcome outcome = Run(scene, output_);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, MatchesRegex("launcher: [^\n]*\n"));
    const std::vector<json> lines = Lines(output_);
    ASSERT_THAT(lines, SizeIs(1));
    EXPECT_FALSE(lines[0].contains("error"));
    EXPECT_THAT(lines[0].at("objects"), IsEmpty());
    EXPECT_TRUE(fs::exists(output_ + "/" + fs::path(scene).filename().string() + ".overlay.png"));
  }
};

TEST_F(BadInputTest, GoesOnAfterUnreadableScenesAndEndsWithOne) {
  RenderScene("a");
  fs::resize_file(RenderScene("b") + "/depth.png", 5000);
  fs::create_directories(scenes_ + "/c");
  folder_.Write("scenes/c/scene.json", kCameraAndScale);
  WriteScene("d",
             R"({"width": 1600, "height": 1200, "fx": 1312, "fy": 1312, "cx": 799.5, "cy": 599.5,
                 "depth_scale_m": 0.001})",
             Noise(1600, 1200));
  RenderScene("e");
  const Outcome outcome = Run(scenes_, output_);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("b: b/depth.png: truncated PNG\n"),
                                 HasSubstr("c: c/depth.png: No such file or directory\n")));
  EXPECT_THAT(Frames(output_), ElementsAre("a", "b", "c", "d", "e"));
  const std::vector<json> lines = Lines(output_);
  EXPECT_EQ(lines[0].at("objects").size(), 2u);
  EXPECT_EQ(lines[1].at("error"), "b/depth.png: truncated PNG");
  EXPECT_EQ(lines[2].at("error"), "c/depth.png: No such file or directory");
  EXPECT_THAT(lines[3].at("error").get<std::string>(), HasSubstr("the limit is 190000"));
  EXPECT_EQ(lines[4].at("objects"), lines[0].at("objects"));
}

TEST_F(BadInputTest, ReportsADepthImageThatIsNoPng) {
  const std::string scene = WriteScene("a", kCameraAndScale, Uniform(640, 480, 900));
  folder_.Write("scenes/a/depth.png", "not an image");
  ExpectError(scene, "depth.png: not a PNG file");
}

TEST_F(BadInputTest, ReportsADepthImageOfAnotherSizeThanTheIntrinsicsSay) {
  ExpectError(WriteScene("a", kCameraAndScale, Uniform(320, 240, 900)),
              "depth.png: 320 x 240 px, but the intrinsics are for 640 x 480 px");
}

TEST_F(BadInputTest, ReportsAnEightBitDepthImage) {
  const std::string scene = WriteScene("a", kCameraAndScale, Uniform(640, 480, 900));
  imaging::WriteGray8Png(scene + "/depth.png", {640, 480, std::vector<uint8_t>(640 * 480, 90)});
  ExpectError(scene, "depth.png: 8-bit grey PNG where 16-bit grey is needed");
}

TEST_F(BadInputTest, ReportsADepthImageWithoutSceneJson) {
  ExpectError(WriteScene("a", "", Uniform(640, 480, 900)), "scene.json: No such file or directory");
}

TEST_F(BadInputTest, ReportsWhatIsWrongInSceneJson) {
  const auto expect_error = [this](const std::string& scene_json, const std::string& error) {
    ExpectError(WriteScene("a", scene_json, Uniform(640, 480, 900)), "scene.json: " + error);
  };
  expect_error("{\"width\": 640,", "not JSON: parse error at line 1");
  expect_error(std::string(kCamera) + "}", "depth_scale_m is missing");
  expect_error(std::string(kCamera) + R"(, "depth_scale_m": -0.001})",
               "depth_scale_m = -0.001 outside [1e-06, 1]");
  expect_error(std::string(kCamera) + R"(, "depth_scale_m": NaN})", "not JSON: parse error");
}

TEST_F(BadInputTest, ReportsAnImageTooLargeForTheGraph) {
  const std::string wide = R"({"width": 5000, "height": 480, "fx": 525, "fy": 525, "cx": 319.5,)"
                           R"( "cy": 239.5, "depth_scale_m": 0.001})";
  ExpectError(WriteScene("a", wide, Uniform(5000, 480, 900)),
              "scene.json: width = 5000 outside [1, 4096]");
}

TEST_F(BadInputTest, FindsNothingWhereNothingWasMeasured) {
  ExpectNothingFound(WriteScene("a", kCameraAndScale, Uniform(640, 480, 0)));
}

TEST_F(BadInputTest, FindsNothingWhereThereIsNoPlane) {
  imaging::GrayImage<uint16_t> sparse = Uniform(640, 480, 0);
  for (size_t i = 0; i < sparse.pixels.size(); i += 8191) sparse.pixels[i] = 900;
  ExpectNothingFound(WriteScene("a", kCameraAndScale, sparse));
  EXPECT_THAT(Lines(output_).at(0).at("planes"), IsEmpty());
}

TEST_F(BadInputTest, FindsNothingOnAnEmptyTable) {
  const std::string text = folder_.Write("empty.textproto", "table {}");
  const std::string scene = folder_.Path("scenes/a");
  ASSERT_EQ(Launched({Program("scene_renderer"), text, scene}, folder_).Wait().code, 0);
  ExpectNothingFound(scene);
  EXPECT_THAT(Lines(output_).at(0).at("planes"), SizeIs(1));
}

TEST_F(BadInputTest, EndsWithTwoWhenThereIsNothingToRead) {
  const Outcome missing = Run(folder_.Path("no_such_folder"), output_);
  EXPECT_EQ(missing.code, 2);
  EXPECT_THAT(missing.err, HasSubstr("no_such_folder: no such file or folder\n"));
  fs::create_directory(scenes_);
  const Outcome empty = Run(scenes_, output_);
  EXPECT_EQ(empty.code, 2);
  EXPECT_THAT(empty.err, HasSubstr("scenes: nothing to read: "));
}

TEST_F(BadInputTest, StartsNothingWithoutInputOrOutput) {
  const std::string graph = std::string(CONFIG_FOLDER) + "/" + graph_;
  const Outcome outcome = Run("", "");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr(graph + ":5:1: kinect_source.input must be set"),
                                 HasSubstr(graph + ":10:1: object_exporter.output must be set")));
  EXPECT_FALSE(fs::exists(folder_.Path("logs/latest")));
}

TEST_F(BadInputTest, EndsWithTwoWhenTheOutputFolderCannotBeMade) {
  const std::string file = folder_.Write("file", "precious");
  const Outcome outcome = Run(WriteScene("a", kCameraAndScale, Uniform(640, 480, 900)), file);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("object_exporter: " + file + ": Not a directory\n"));
  EXPECT_EQ(ReadFile(file), "precious");
}

TEST_F(BadInputTest, WritesTheLineAndEndsWithOneWhenAPictureCannotBeWritten) {
  fs::create_directories(output_ + "/a.labels.png");
  const Outcome outcome = Run(WriteScene("a", kCameraAndScale, Uniform(640, 480, 900)), output_);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("a.labels.png: Is a directory\n"));
  EXPECT_THAT(Frames(output_), ElementsAre("a"));
}

TEST_F(BadInputTest, NeedsTheCameraOfACloudThatIsNoGrid) {
  fs::create_directories(scenes_);
  const std::string cloud = folder_.Write(
      "scenes/cloud.pcd",
      "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 3\nHEIGHT 1\nPOINTS 3\n"
      "DATA ascii\n0 0 0.9\n0.1 0 0.9\nnan nan nan\n");
  const Outcome unknown = Run(cloud, output_);
  EXPECT_EQ(unknown.code, 1);
  EXPECT_THAT(unknown.err, HasSubstr("not organised (height 1) and its camera is not known"));
  ASSERT_THAT(Lines(output_), SizeIs(1));
  EXPECT_TRUE(Lines(output_)[0].contains("error"));

  folder_.Write("scenes/intrinsics.json", kCameraAndScale);
  const Outcome known = Run(cloud, output_);
  EXPECT_EQ(known.code, 0) << known.err;
  ASSERT_THAT(Lines(output_), SizeIs(1));
  EXPECT_FALSE(Lines(output_)[0].contains("error"));
}

TEST_F(BadInputTest, NeedsTheCameraOfAFolderOfDepthImages) {
  const std::string images = folder_.Path("sequence");
  fs::create_directories(images + "/depth");
  fs::copy_file(RenderScene("a") + "/depth.png", images + "/depth/1305031102.160407.png");
  folder_.Write("sequence/depth/1305031102.194330.png", "damaged");
  const Outcome unknown = Run(images, output_);
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("sequence/intrinsics.json: No such file or directory"));

  folder_.Write("sequence/intrinsics.json", kCameraAndScale);
  EXPECT_EQ(Run(images, output_).code, 1);
  const std::vector<json> lines = Lines(output_);
  ASSERT_THAT(lines, SizeIs(2));
  EXPECT_EQ(lines[0].at("utime"), 1305031102160407);
  EXPECT_THAT(lines[0].at("objects"), SizeIs(2));
  EXPECT_EQ(lines[1].at("error"), "depth/1305031102.194330.png: not a PNG file");
}

}  // namespace
}  // namespace declutter
