#include <OpenNI.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/process/sensor_run.h"

namespace declutter {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

class OniTest : public SensorRun {
 protected:
  // Records frames of a live run; what the run published is in its log.
  void Record(int num_frames, const std::string& sensor) {
    const Outcome outcome =
        Run(Live(sensor), "warm_up_frames: 0 num_frames: " + std::to_string(num_frames) +
                              " record_oni: \"" + oni_ + "\"");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    ASSERT_TRUE(fs::exists(oni_));
  }

  const std::string oni_ = folder_.Path("a.oni");
};

TEST_F(OniTest, PlaysEveryFrameAsItWasRecorded) {
  Record(40, WriteSensor(""));
  const SensorLog live = ReadLog();
  const Outcome outcome = Run(oni_, "", true);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const SensorLog played = ReadLog();
  ASSERT_GE(played.depth.size(), 40u);
  // The recording may end between a depth image and its colour.
  ASSERT_GE(played.color_utimes.size(), played.depth.size() - 1);
  for (size_t i = 0; i + 1 < played.depth.size(); ++i) {
    EXPECT_EQ(played.color_utimes[i], played.depth[i].header.utime);
  }
  for (size_t i = 0; i < played.depth.size(); ++i) {
    const DepthFrame& frame = played.depth[i];
    EXPECT_EQ(frame.image.counts, live.depth[0].image.counts);
    EXPECT_EQ(frame.image.camera.fx, live.depth[0].image.camera.fx);
    EXPECT_NEAR(static_cast<double>(frame.header.utime), 1e6 / 30 * static_cast<double>(i), 40);
  }
  EXPECT_EQ(played.depth[1].header.frame, "000001");
}

TEST_F(OniTest, PlaysForEverWhenAsked) {
  Record(4, WriteSensor(""));
  const Outcome outcome = Run(oni_, "loop: true num_frames: 60", true);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const SensorLog log = ReadLog();
  ASSERT_EQ(log.depth.size(), 60u);
  size_t length = 1;  // of a loop
  while (length < 60 && log.depth[length].header.frame != "000000") ++length;
  ASSERT_LT(length, 60u);
  const auto has_color = [&log](size_t i) {
    return std::count(log.color_utimes.begin(), log.color_utimes.end(), log.depth[i].header.utime);
  };
  for (size_t i = 0; i < 60; ++i) {
    EXPECT_EQ(log.depth[i].header.frame, log.depth[i % length].header.frame);
    EXPECT_EQ(has_color(i), has_color(i % length)) << i;
    if (i == 0) continue;
    EXPECT_GT(log.depth[i].header.utime, log.depth[i - 1].header.utime);
    EXPECT_EQ(log.depth[i].header.frame > log.depth[i - 1].header.frame, i % length > 0);
  }
}

TEST_F(OniTest, PlaysAtTheRateOfTheRecording) {
  Record(30, WriteSensor(""));
  ASSERT_EQ(Run(oni_, "").code, 0);
  const SensorLog log = ReadLog();
  ASSERT_GE(log.depth.size(), 28u);
  const int64_t duration_us = log.depth_logged_us.back() - log.depth_logged_us.front();
  const int64_t taken_us = log.depth.back().header.utime - log.depth.front().header.utime;
  EXPECT_GT(duration_us, taken_us / 2);  // a busy machine may begin late and catch up
}

TEST_F(OniTest, GoesOnInAnotherFileAfterTheSensorWasUnplugged) {
  Record(60, WriteSensor("fault { kind: \"unplug\" begin: 20 num_periods: 20 }"));
  ASSERT_TRUE(fs::exists(folder_.Path("a-2.oni")));
  EXPECT_EQ(Run(oni_, "", true).code, 0);
  EXPECT_EQ(ReadLog().depth.size(), 20u);
  EXPECT_EQ(Run(folder_.Path("a-2.oni"), "", true).code, 0);
  EXPECT_GE(ReadLog().depth.size(), 38u);
}

TEST_F(OniTest, RecordsNothingOnAFullDiskAndGoesOn) {
  const Outcome outcome = Run(Live(WriteSensor("")),
                              "num_frames: 5 record_min_free_mb: 1e9 record_oni: \"" + oni_ + "\"");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("a.oni: recording ends: less than 1000000000 MB free"));
  EXPECT_FALSE(fs::exists(oni_));
  EXPECT_EQ(ReadLog().depth.size(), 5u);
}

TEST_F(OniTest, OverwritesNothing) {
  folder_.Write("a.oni", "precious");
  const Outcome outcome = Run(Live(WriteSensor("")), "record_oni: \"" + oni_ + "\"");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("a.oni: exists already"));
  EXPECT_EQ(ReadFile(oni_), "precious");
}

TEST_F(OniTest, RefusesAFileThatIsCutShort) {
  Record(10, WriteSensor(""));
  fs::resize_file(oni_, fs::file_size(oni_) / 5);  // more than half of it is room not used
  const Outcome outcome = Run(oni_, "", true);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("(cut short, or no .oni file?)"));
}

TEST_F(OniTest, RefusesAFileThatIsNone) {
  folder_.Write("a.oni", "no recording");
  EXPECT_EQ(Run(oni_, "", true).code, 2);
  EXPECT_EQ(Run(folder_.Path("b.oni"), "", true).code, 2);
}

TEST_F(OniTest, RefusesAFileWithoutDepth) {
  const std::string uri = "synthetic:" + WriteSensor("");
  ASSERT_EQ(openni::OpenNI::initialize(), openni::STATUS_OK);
  {
    openni::Device device;
    ASSERT_EQ(device.open(uri.c_str()), openni::STATUS_OK);
    openni::VideoStream color;
    ASSERT_EQ(color.create(device, openni::SENSOR_COLOR), openni::STATUS_OK);
    openni::Recorder recorder;
    ASSERT_EQ(recorder.create(oni_.c_str()), openni::STATUS_OK);
    ASSERT_EQ(recorder.attach(color), openni::STATUS_OK);
    ASSERT_EQ(recorder.start(), openni::STATUS_OK);
    ASSERT_EQ(color.start(), openni::STATUS_OK);
    openni::VideoFrameRef frame;
    for (int i = 0; i < 5; ++i) ASSERT_EQ(color.readFrame(&frame), openni::STATUS_OK);
    frame.release();
    color.stop();
    recorder.destroy();
    color.destroy();
  }
  openni::OpenNI::shutdown();
  const Outcome outcome = Run(oni_, "", true);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("a.oni: has no depth stream"));
}

// The objects of the first frame that the whole graph finds.
json FirstObjects(const std::string& output) {
  std::istringstream lines(ReadFile(output + "/objects.jsonl"));
  std::string line;
  std::getline(lines, line);
  return json::parse(line).at("objects");
}

TEST_F(OniTest, GivesTheObjectsOfTheSceneFolder) {
  Record(3, WriteSensor("", ""));
  const std::string renderer = fs::path(LAUNCHER).parent_path() / "scene_renderer";
  const std::string scene = folder_.Path("rendered");
  ASSERT_EQ(Launched({renderer, folder_.Path("scene.textproto"), scene}, folder_).Wait().code, 0);
  std::vector<json> found;
  for (const std::string& input : {scene, oni_}) {
    const std::string output = folder_.Path("out" + std::to_string(found.size()));
    const Outcome outcome =
        RunLauncher({"run", std::string(CONFIG_FOLDER) + "/recordings.textproto", "--set",
                     "kinect_source.input=" + input, "--set", "kinect_source.num_frames=1", "--set",
                     "object_exporter.output=" + output},
                    folder_);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    found.push_back(FirstObjects(output));
  }
  ASSERT_EQ(found[0].size(), 1u);
  ASSERT_EQ(found[1].size(), 1u);
  for (const char* key : {"position", "orientation", "size"}) {
    for (size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(found[0][0].at(key).at(i), found[1][0].at(key).at(i), 1e-4) << key;
    }
  }
}

}  // namespace
}  // namespace declutter
