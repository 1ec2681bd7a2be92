#include <OpenNI.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <set>

#include "tests/process/sensor_run.h"

namespace declutter {
namespace {

using ::testing::HasSubstr;

using SensorTest = SensorRun;

TEST_F(SensorTest, PublishesTheRenderedImagesBitForBit) {
  const std::string sensor = WriteSensor("num_images: 3", "");
  const Outcome outcome = Run(Live(sensor), "num_frames: 12 warm_up_frames: 0");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const SensorLog log = ReadLog();
  const RenderedImages rendered = Rendered(sensor);
  ASSERT_EQ(log.depth.size(), 12u);
  std::set<size_t> seen;
  for (const DepthFrame& frame : log.depth) {
    const auto match =
        std::find_if(rendered.depth.begin(), rendered.depth.end(),
                     [&](const DepthImage& image) { return image.counts == frame.image.counts; });
    ASSERT_NE(match, rendered.depth.end()) << frame.header.frame;
    seen.insert(static_cast<size_t>(match - rendered.depth.begin()));
    EXPECT_EQ(frame.image.depth_scale_m, 0.001);
    EXPECT_NEAR(frame.image.camera.fx, match->camera.fx, 1e-4);
    EXPECT_NEAR(frame.image.camera.fy, match->camera.fy, 1e-4);
    EXPECT_EQ(frame.image.camera.cx, match->camera.cx);
    EXPECT_EQ(frame.image.camera.cy, match->camera.cy);
  }
  EXPECT_EQ(seen.size(), 3u);
}

TEST_F(SensorTest, SendsColourOfTheSameTimeAsDepth) {
  ASSERT_EQ(Run(Live(WriteSensor("")), "num_frames: 30").code, 0);
  const SensorLog log = ReadLog();
  std::set<int64_t> depth_utimes;
  for (const DepthFrame& frame : log.depth) depth_utimes.insert(frame.header.utime);
  for (const int64_t utime : log.color_utimes) EXPECT_EQ(depth_utimes.count(utime), 1u);
  EXPECT_GE(log.color_utimes.size(), 25u);
}

TEST_F(SensorTest, SendsNoColourThatIsNotRegistered) {
  const Outcome outcome = Run(Live(WriteSensor("can_register: false")), "num_frames: 5");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("cannot register depth to colour: no colour"));
  const SensorLog log = ReadLog();
  EXPECT_EQ(log.depth.size(), 5u);
  EXPECT_TRUE(log.color_utimes.empty());
}

TEST_F(SensorTest, ALosslessRunTakesTheNewestFrameAfterEachResult) {
  const Outcome outcome = Run(Live(WriteSensor("")), "num_frames: 5", true);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(ReadLog().depth.size(), 5u);
}

TEST_F(SensorTest, ReadsTheSizeAskedFor) {
  const std::string sensor = WriteSensor("", "");
  ASSERT_EQ(Run(Live(sensor), "num_frames: 2 width: 320 height: 240").code, 0);
  const DepthImage half = ReadLog().depth.at(0).image, full = Rendered(sensor).depth.at(0);
  EXPECT_EQ(half.camera.width, 320);
  EXPECT_NEAR(half.camera.fx, full.camera.fx / 2, 1e-4);
  for (int v = 0; v < 240; v += 7) {
    for (int u = 0; u < 320; u += 7) EXPECT_EQ(half.CountAt(u, v), full.CountAt(2 * u, 2 * v));
  }
}

// With room for a machine that is busy with other things.
TEST_F(SensorTest, HoldsThirtyFramesASecond) {
  const int num_frames = ShortOrSoak(300, 1800);
  const Outcome outcome =
      Run(Live(WriteSensor("", "")), "num_frames: " + std::to_string(num_frames));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const SensorLog log = ReadLog();
  ASSERT_GE(log.depth.size(), num_frames * 0.97);  // what was lost on the way to the recorder
  for (size_t i = 1; i < log.depth.size(); ++i) {
    EXPECT_GT(log.depth[i].header.utime, log.depth[i - 1].header.utime);
  }
  const int64_t num_skipped = log.statuses.back().content.num_skipped;
  EXPECT_LE(num_skipped, num_frames * 0.01 * ShortOrSoak(30, 5));
  const double duration_s =
      1e-6 * static_cast<double>(log.depth.back().header.utime - log.depth.front().header.utime);
  // Timestamps are late by at most what the first frame was late.
  EXPECT_NEAR(duration_s, static_cast<double>(num_frames - 1 + num_skipped) / 30, 2);
  std::printf("%zu frames in %.2f s, %lld skipped\n", log.depth.size(), duration_s,
              static_cast<long long>(num_skipped));
}

TEST_F(SensorTest, RefusesAModeThatTheSensorLacks) {
  const Outcome outcome = Run(Live(WriteSensor("", "")), "width: 1280 height: 1024");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("no depth with 1280x1024 px; supported: 640x480 at 30 Hz, "
                                     "320x240 at 30 Hz"));
  const Outcome rate = Run(Live(WriteSensor("")), "rate_hz: 60");
  EXPECT_EQ(rate.code, 2);
  EXPECT_THAT(rate.err, HasSubstr("no depth with 60 Hz; supported: 320x240 at 30 Hz"));
}

TEST_F(SensorTest, SaysWhatIsWrongWithTheSensorsFile) {
  const std::string sensor =
      folder_.Write("bad.textproto", "scene: \"a\"\nfault { kind: \"burn\" }");
  const Outcome outcome = Run(Live(sensor), "");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("bad.textproto:2:9: fault.kind"));
}

TEST_F(SensorTest, ASensorIsForOneProgramAtATime) {
  const std::string sensor = WriteSensor("");
  const std::string program = std::filesystem::path(LAUNCHER).parent_path() / "kinect_source";
  TemporaryFolder other;
  setenv("LCM_DEFAULT_URL", "udpm://239.255.76.67:7872?ttl=0", 1);
  const Launched first({program, "--set", "input=" + Live(sensor)}, other);
  ASSERT_TRUE(Eventually([&other] {
    return ReadFile(other.Path("stderr")).find("synthetic sensor") != std::string::npos;
  }));
  const Outcome second = Launched({program, "--set", "input=" + Live(sensor)}, folder_).Wait();
  unsetenv("LCM_DEFAULT_URL");
  EXPECT_EQ(second.code, 1);
  EXPECT_THAT(second.err, HasSubstr("in use by another program"));
}

TEST_F(SensorTest, UsesACalibrationInPlaceOfTheFieldOfView) {
  const std::string calibration = folder_.Write("camera.yaml", R"(image_width: 320
image_height: 240
camera_matrix: { rows: 3, cols: 3, data: [270, 0, 161, 0, 271, 118, 0, 0, 1] }
)");
  const std::string sensor = WriteSensor("", "");
  ASSERT_EQ(
      Run(Live(sensor), "num_frames: 2 depth_scale: 1.1 intrinsics_file: \"" + calibration + "\"")
          .code,
      0);
  const DepthImage read = ReadLog().depth.at(0).image, rendered = Rendered(sensor).depth.at(0);
  EXPECT_EQ(read.camera.width, 320);  // the size that was calibrated
  EXPECT_EQ(read.camera.fx, 270);
  EXPECT_EQ(read.camera.cy, 118);
  EXPECT_EQ(read.CountAt(160, 200), std::lround(1.1 * rendered.CountAt(320, 400)));
}

// What a program sees that uses the driver for itself.
TEST_F(SensorTest, IsADeviceThatCropsAndMirrors) {
  const std::string sensor = WriteSensor("");
  const DepthImage rendered = Rendered(sensor).depth.at(0);
  ASSERT_EQ(openni::OpenNI::initialize(), openni::STATUS_OK);
  {
    openni::Device device;
    ASSERT_EQ(device.open(("synthetic:" + sensor).c_str()), openni::STATUS_OK);
    openni::VideoStream depth;
    ASSERT_EQ(depth.create(device, openni::SENSOR_DEPTH), openni::STATUS_OK);
    EXPECT_TRUE(depth.getMirroringEnabled());
    EXPECT_EQ(depth.setCropping(300, 0, 100, 10), openni::STATUS_BAD_PARAMETER);
    ASSERT_EQ(depth.setCropping(10, 200, 100, 20), openni::STATUS_OK);
    ASSERT_EQ(depth.start(), openni::STATUS_OK);
    EXPECT_NE(depth.setMirroringEnabled(false), openni::STATUS_OK);  // not while it runs
    openni::VideoFrameRef frame;
    ASSERT_EQ(depth.readFrame(&frame), openni::STATUS_OK);
    ASSERT_EQ(frame.getWidth(), 100);
    ASSERT_EQ(frame.getHeight(), 20);
    const auto* counts = static_cast<const uint16_t*>(frame.getData());
    EXPECT_EQ(counts[0], rendered.CountAt(319 - 10, 200));
    EXPECT_EQ(counts[20 * 100 - 1], rendered.CountAt(319 - 109, 219));
    frame.release();
    depth.stop();
    depth.destroy();
    device.close();
  }
  openni::OpenNI::shutdown();
}

// Sensors that OpenNI2 lists by itself.
class ListedSensorTest : public SensorTest {
 protected:
  void SetUp() override {
    setenv("DECLUTTER_SYNTHETIC_SENSOR", WriteSensor("serial: \"S42\"").c_str(), 1);
  }
  void TearDown() override { unsetenv("DECLUTTER_SYNTHETIC_SENSOR"); }
};

TEST_F(ListedSensorTest, IsOpenedAsAnySensor) {
  const Outcome outcome = Run("live", "num_frames: 3");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(ReadLog().depth.size(), 3u);
}

TEST_F(ListedSensorTest, IsOpenedByItsSerialNumber) {
  EXPECT_EQ(Run("live:serial=S42", "num_frames: 3").code, 0);
  const Outcome other = Run("live:serial=S43", "");
  EXPECT_EQ(other.code, 1);
  EXPECT_THAT(other.err, HasSubstr("no sensor with serial number S43; connected: synthetic:"));
  EXPECT_THAT(other.err, HasSubstr("(serial S42)"));
}

TEST_F(ListedSensorTest, IsListed) {
  const std::string program = std::filesystem::path(LAUNCHER).parent_path() / "list_sensors";
  const Outcome outcome = Launched({program}, folder_).Wait();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("driver libOniFile.so.0\n"));
  EXPECT_THAT(outcome.out, HasSubstr("declutter synthetic sensor, serial S42\n"));
}

TEST_F(SensorTest, SaysThatThereIsNoSensor) {
  const Outcome outcome = Run("live", "");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("no sensor can be opened; connected: none"));
}

}  // namespace
}  // namespace declutter
