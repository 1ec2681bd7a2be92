#include "modules/object_exporter/object_exporter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "modules/imaging/png_file.h"
#include "modules/imaging/temporary_folder.h"

namespace declutter {
namespace {

using nlohmann::json;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

ObjectList Frame(int64_t utime, const std::string& name) {
  ObjectList list;
  list.header = {utime, name, ""};
  list.camera = {4, 3, 10, 10, 1.5, 1};
  list.labels = {0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0};
  return list;
}

class ObjectExporterTest : public ::testing::Test {
 protected:
  ObjectExporterTest() { config_.set_output(folder_ / "out"); }

  std::filesystem::path Path(const std::string& name) const {
    return folder_.path() / "out" / name;
  }

  std::vector<json> Lines() const {
    std::vector<json> lines;
    std::ifstream file(Path("objects.jsonl"));
    for (std::string line; std::getline(file, line);) lines.push_back(json::parse(line));
    return lines;
  }

  std::vector<std::string> FrameNames() const {
    std::vector<std::string> names;
    for (const json& line : Lines()) names.push_back(line.at("frame"));
    return names;
  }

  imaging::TemporaryFolder folder_;
  ObjectExporterConfig config_;
};

TEST_F(ObjectExporterTest, WritesALineAndTwoPicturesPerFrame) {
  ObjectExporter exporter(config_);
  exporter.Export(Frame(0, "mug"));
  EXPECT_THAT(FrameNames(), ElementsAre("mug"));
  EXPECT_EQ(imaging::ReadGray8Png(Path("mug.labels.png")).pixels, Frame(0, "mug").labels);
  EXPECT_EQ(imaging::ReadRgbPng(Path("mug.overlay.png")).width, 4);
}

TEST_F(ObjectExporterTest, ALineIsThereAsSoonAsItIsWritten) {
  ObjectExporter exporter(config_);
  exporter.Export(Frame(0, "a"));
  EXPECT_EQ(Lines().size(), 1u);
  exporter.Export(Frame(1, "b"));
  EXPECT_EQ(Lines().size(), 2u);
}

TEST_F(ObjectExporterTest, DrawsOverTheColourOfTheSameTime) {
  ObjectExporter exporter(config_);
  exporter.AddColor(1, {4, 3, std::vector<uint8_t>(36, 90)});
  exporter.AddColor(2, {4, 3, std::vector<uint8_t>(36, 180)});
  ObjectList list = Frame(1, "a");
  list.labels.assign(12, 0);
  exporter.Export(list);
  EXPECT_THAT(imaging::ReadRgbPng(Path("a.overlay.png")).rgb, Each(90));
}

TEST_F(ObjectExporterTest, DrawsOverDepthWithoutColour) {
  ObjectExporter exporter(config_);
  DepthFrame depth;
  depth.header.utime = 1;
  depth.image = {{4, 3, 10, 10, 1.5, 1}, 0.001, std::vector<uint16_t>(12, 700)};
  exporter.AddDepth(depth);
  ObjectList list = Frame(1, "a");
  list.labels.assign(12, 0);
  exporter.Export(list);
  EXPECT_THAT(imaging::ReadRgbPng(Path("a.overlay.png")).rgb, Each(testing::Gt(0)));
}

// The frame of the list above, of a sensor with 7 x 5 pixels.
DepthFrame DecimatedDepth(int64_t utime) {
  DepthFrame depth;
  depth.header.utime = utime;
  depth.image = {{4, 3, 10, 10, 1.5, 1}, 0.001, std::vector<uint16_t>(12, 700)};
  depth.decimation = Decimation{2, 7, 5};
  return depth;
}

TEST_F(ObjectExporterTest, RepeatsTheLabelsOfADecimatedFrameToTheSensorsSize) {
  ObjectExporter exporter(config_);
  exporter.AddDepth(DecimatedDepth(1));
  ObjectList list = Frame(1, "a");
  list.labels = {0, 0, 0, 3, 0, 1, 2, 0, 4, 0, 0, 0};
  exporter.Export(list);
  const auto labels = imaging::ReadGray8Png(Path("a.labels.png"));
  EXPECT_EQ(labels.width, 7);
  EXPECT_EQ(labels.height, 5);
  EXPECT_THAT(labels.pixels, ElementsAre(0, 0, 0, 0, 0, 0, 3,  //
                                         0, 0, 0, 0, 0, 0, 3,  //
                                         0, 0, 1, 1, 2, 2, 0,  //
                                         0, 0, 1, 1, 2, 2, 0,  //
                                         4, 4, 0, 0, 0, 0, 0));
}

TEST_F(ObjectExporterTest, DrawsADecimatedFrameOverTheSensorsColourOrDepth) {
  ObjectExporter exporter(config_);
  exporter.AddDepth(DecimatedDepth(1));
  exporter.AddColor(1, {7, 5, std::vector<uint8_t>(105, 90)});
  exporter.AddDepth(DecimatedDepth(2));
  for (int64_t utime : {1, 2}) {
    ObjectList list = Frame(utime, utime == 1 ? "color" : "depth");
    list.labels.assign(12, 0);
    exporter.Export(list);
  }
  EXPECT_THAT(imaging::ReadRgbPng(Path("color.overlay.png")).rgb, Each(90));
  const ColorImage grey = imaging::ReadRgbPng(Path("depth.overlay.png"));
  EXPECT_EQ(grey.width, 7);
  EXPECT_EQ(grey.height, 5);
  EXPECT_THAT(grey.rgb, Each(testing::Gt(0)));
}

TEST_F(ObjectExporterTest, WritesPicturesOfFeaturesWhenAsked) {
  FeatureCloud features;
  features.header.utime = 1;
  features.width = 4;
  features.height = 3;
  for (const bool is_asked : {false, true}) {
    config_.set_feature_pictures(is_asked);
    ObjectExporter exporter(config_);
    exporter.AddFeatures(features);
    exporter.Export(Frame(1, "a"));
    for (const std::string picture : {"a.curvature.png", "a.r_min.png"}) {
      ASSERT_EQ(std::filesystem::exists(Path(picture)), is_asked) << picture;
    }
  }
  EXPECT_EQ(imaging::ReadRgbPng(Path("a.curvature.png")).width, 4);
}

TEST_F(ObjectExporterTest, IgnoresAFrameThatWasWritten) {
  ObjectExporter exporter(config_);
  exporter.Export(Frame(0, "a"));
  exporter.Export(Frame(1, "b"));
  ObjectList again = Frame(0, "a");
  again.header.error = "no result after 5 tries";
  exporter.Export(again);
  EXPECT_THAT(FrameNames(), ElementsAre("a", "b"));
}

TEST_F(ObjectExporterTest, WritesAnErrorWithoutPictures) {
  ObjectExporter exporter(config_);
  ObjectList list;
  list.header = {0, "a", "depth.png: truncated PNG"};
  exporter.Export(list);
  EXPECT_EQ(Lines().at(0).at("error"), "depth.png: truncated PNG");
  EXPECT_FALSE(std::filesystem::exists(Path("a.labels.png")));
  EXPECT_FALSE(std::filesystem::exists(Path("a.overlay.png")));
}

TEST_F(ObjectExporterTest, WritesOnlyLinesWithoutPictures) {
  config_.set_pictures(false);
  ObjectExporter exporter(config_);
  exporter.Export(Frame(0, "a"));
  EXPECT_EQ(Lines().size(), 1u);
  EXPECT_FALSE(std::filesystem::exists(Path("a.labels.png")));
}

TEST_F(ObjectExporterTest, FramesOfOneNameKeepTheirOwnPictures) {
  ObjectExporter exporter(config_);
  ObjectList second = Frame(1, "a");
  second.labels.assign(12, 7);
  exporter.Export(Frame(0, "a"));
  exporter.Export(second);
  EXPECT_EQ(imaging::ReadGray8Png(Path("a.labels.png")).pixels, Frame(0, "a").labels);
  EXPECT_EQ(imaging::ReadGray8Png(Path("a-2.labels.png")).pixels, second.labels);
  EXPECT_EQ(Lines().at(1).at("frame"), "a");
  EXPECT_EQ(Lines().at(1).at("labels"), "a-2.labels.png");
}

TEST_F(ObjectExporterTest, NeverWritesOutsideItsFolder) {
  ObjectExporter exporter(config_);
  exporter.Export(Frame(0, "../../evil"));
  exporter.Export(Frame(1, "/tmp/evil"));
  exporter.Export(Frame(2, std::string("a\0b\n", 4)));
  exporter.Export(Frame(3, ""));
  exporter.Export(Frame(4, std::string(500, 'x')));
  EXPECT_EQ(Lines().size(), 5u);
  EXPECT_TRUE(std::filesystem::exists(Path(".._.._evil.labels.png")));
  EXPECT_TRUE(std::filesystem::exists(Path("_tmp_evil.labels.png")));
  EXPECT_TRUE(std::filesystem::exists(Path("a_b_.labels.png")));
  EXPECT_TRUE(std::filesystem::exists(Path("frame.labels.png")));
  EXPECT_TRUE(std::filesystem::exists(Path(std::string(200, 'x') + ".labels.png")));
}

TEST_F(ObjectExporterTest, BeginsTheLinesAnewAndLeavesOtherFiles) {
  std::filesystem::create_directories(Path(""));
  std::ofstream(Path("objects.jsonl")) << "old\n";
  std::ofstream(Path("notes.txt")) << "mine\n";
  ObjectExporter exporter(config_);
  exporter.Export(Frame(0, "a"));
  EXPECT_THAT(FrameNames(), ElementsAre("a"));
  EXPECT_TRUE(std::filesystem::exists(Path("notes.txt")));
}

TEST_F(ObjectExporterTest, RefusesAFolderThatCannotBe) {
  const auto refusal = [&](const std::string& output) -> std::string {
    config_.set_output(output);
    try {
      ObjectExporter exporter(config_);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "not refused";
  };
  std::ofstream(folder_ / "file") << "x";
  EXPECT_THAT(refusal(folder_ / "file"), HasSubstr("file: "));
  EXPECT_THAT(refusal(folder_ / "file/below"), HasSubstr("Not a directory"));
  std::filesystem::create_directories(folder_.path() / "taken/objects.jsonl");
  EXPECT_THAT(refusal(folder_ / "taken"), HasSubstr("objects.jsonl: Is a directory"));
}

TEST_F(ObjectExporterTest, WritesTheLineWhenAPictureCannotBeWritten) {
  ObjectExporter exporter(config_);
  std::filesystem::create_directories(Path("a.labels.png"));
  try {
    exporter.Export(Frame(0, "a"));
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("a.labels.png: Is a directory"));
  }
  EXPECT_THAT(FrameNames(), ElementsAre("a"));
  EXPECT_FALSE(Lines().at(0).contains("labels"));
}

TEST_F(ObjectExporterTest, SaysThatTheDiskIsFull) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  std::filesystem::create_directories(Path(""));
  std::filesystem::create_symlink("/dev/full", Path("objects.jsonl"));
  config_.set_pictures(false);
  ObjectExporter exporter(config_);
  for (int i = 0; i < 2; ++i) {
    try {
      exporter.Export(Frame(i, "a"));
      FAIL();
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr("objects.jsonl: No space left on device"));
    }
  }
}

}  // namespace
}  // namespace declutter
