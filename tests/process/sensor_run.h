#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "modules/codec/codec.h"
#include "modules/runtime/config.h"
#include "modules/runtime/event_log.h"
#include "modules/synthetic_sensor/rendered_images.h"
#include "tests/process/fake_graph.h"
#include "tests/process/launched.h"

namespace declutter {

// How long a test lasts: long in tests/soak.sh.
inline int ShortOrSoak(int brief, int soak) {
  return std::getenv("DECLUTTER_SOAK") == nullptr ? brief : soak;
}

// What kinect_source published in a run.
struct SensorLog {
  struct Status {
    int64_t logged_us = 0;  // when it was recorded
    module_status_t content;
  };

  std::vector<DepthFrame> depth;
  std::vector<int64_t> depth_logged_us;
  std::vector<int64_t> color_utimes;
  std::vector<Status> statuses;
};

// kinect_source on a synthetic sensor or an .oni file, with a module behind it that answers every
// frame, as the launcher runs them.
class SensorRun : public testing::Test {
 protected:
  // The file of a sensor that shows a box on a table, in a single image; `fields` are added.
  std::string WriteSensor(const std::string& fields, const std::string& camera = kSmallCamera) {
    folder_.Write(
        "scene.textproto",
        "camera { " + camera +
            " }\nobject { box { size_x_m: 0.16 size_y_m: 0.08 size_z_m: 0.2 } y_m: 0.65 }");
    return folder_.Write("sensor.textproto", "scene: \"scene.textproto\" num_images: 1 " + fields);
  }

  Outcome Run(const std::string& input, const std::string& parameters, bool lossless = false) {
    std::filesystem::remove(log_);
    return RunLauncher({"run", WriteGraph(input, parameters, lossless), "--record", log_}, folder_);
  }

  std::string WriteGraph(const std::string& input, const std::string& parameters, bool lossless) {
    return folder_.Write("graph.textproto",
                         std::string(lossless ? "lossless: true\n" : "") +
                             "module { name: \"kinect_source\" config {\n"
                             "[type.googleapis.com/declutter.KinectSourceConfig] { input: \"" +
                             input + "\" " + parameters +
                             " } } }\nmodule { name: \"filter\" program: \"" + OwnFilter() +
                             "\" }\n");
  }

  // By a name of its own: other tests, at the same time, look for processes by theirs.
  std::string OwnFilter() const {
    const std::string path = folder_.Path("filter");
    std::filesystem::remove(path);
    std::filesystem::create_symlink(Fake("fake_filter"), path);
    return path;
  }

  SensorLog ReadLog() const {
    SensorLog log;
    runtime::EventLogReader reader(log_);
    while (const auto event = reader.Next()) {
      const int size = static_cast<int>(event->message.size());
      if (event->channel == kDepthFrame.name) {
        depth_frame_t message;
        EXPECT_EQ(message.decode(event->message.data(), 0, size), size);
        log.depth.push_back(codec::Decode(message));
        log.depth_logged_us.push_back(event->utime);
      } else if (event->channel == kColorFrame.name) {
        color_frame_t message;
        EXPECT_EQ(message.decode(event->message.data(), 0, size), size);
        log.color_utimes.push_back(message.utime);
      } else if (event->channel == kModuleStatus.name) {
        module_status_t message;
        EXPECT_EQ(message.decode(event->message.data(), 0, size), size);
        if (message.module == "kinect_source") log.statuses.push_back({event->utime, message});
      }
    }
    return log;
  }

  // The images that a sensor shows.
  static RenderedImages Rendered(const std::string& sensor_path) {
    SyntheticSensor sensor;
    runtime::ParseConfig(ReadFile(sensor_path), sensor_path, &sensor);
    return RenderImages(sensor, sensor_path);
  }

  static std::string Live(const std::string& sensor) { return "live:synthetic:" + sensor; }

  static constexpr const char* kSmallCamera =
      "width: 320 height: 240 fx: 262.5 fy: 262.5 cx: 159.5 cy: 119.5";

  TemporaryFolder folder_;
  std::string log_ = folder_.Path("run.lcm");
};

}  // namespace declutter
