#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/process/launched.h"

namespace declutter {
namespace {

constexpr double kLimit_s = 60;  // for a machine that others use too

// What a robot runs, with a synthetic sensor of 30 Hz: more than these modules can do.
class KillTest : public testing::Test {
 protected:
  KillTest() {
    const std::string config = CONFIG_FOLDER;
    const std::string graph = folder_.Write(
        "graph.textproto",
        "include: \"" + config + "/robot.textproto\"\nlogger { min_free_mb: 64 }\n" +
            "module { name: \"object_exporter\" disabled: false restart: \"on_failure\" }\n");
    // One image: rendering more whenever it is opened is nothing that a real sensor does.
    const std::string sensor = folder_.Write(
        "sensor.textproto", "scene: \"" + config + "/scenes/demo.textproto\" num_images: 1");
    launcher_.emplace(
        std::vector<std::string>{LAUNCHER, "run", graph, "--log_dir", folder_.Path("logs"), "--set",
                                 "kinect_source.input=live:synthetic:" + sensor, "--set",
                                 "object_exporter.output=" + folder_.Path("objects"), "--set",
                                 "object_exporter.pictures=false"},
        folder_);
  }

  // 0 while there is none.
  pid_t Find(const std::string& program) const {
    for (const pid_t pid : ProcessesWith(folder_.Path("logs") + "/")) {
      const std::string command = ReadFile("/proc/" + std::to_string(pid) + "/cmdline");
      if (std::filesystem::path(command.c_str()).filename() == program) return pid;
    }
    return 0;
  }

  std::string Err() const { return ReadFile(folder_.Path("stderr")); }

  // When the sensor took the last frame that there is a result of [us].
  int64_t LastUtime() const {
    std::istringstream lines(ReadFile(folder_.Path("objects/objects.jsonl")));
    std::string line, last;
    while (std::getline(lines, line) && !lines.eof()) last = line;  // whole lines
    return last.empty() ? 0 : nlohmann::json::parse(last).at("utime").get<int64_t>();
  }

  // Of what the sensor sees from now on: what was on its way past a process that is killed does not
  // count.
  bool GivesResults() const {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    const int64_t now_us = std::chrono::duration_cast<std::chrono::microseconds>(now).count();
    return Eventually([&] { return LastUtime() > now_us; }, kLimit_s);
  }

  // In the file that it began last.
  bool Records(int number) const {
    const std::string log = folder_.Path("logs/latest/run.lcmlog.0" + std::to_string(number));
    return Eventually([&] { return !UtimesOf("OBJECTS", log).empty(); }, kLimit_s);
  }

  bool IsBack(const std::string& program, pid_t killed) const {
    return IsReplaced([&] { return Find(program); }, killed, kLimit_s);
  }

  TemporaryFolder folder_;
  std::optional<Launched> launcher_;
};

TEST_F(KillTest, GivesResultsAndRecordsThemAgainAfterEachProcessWasKilledThreeTimes) {
  ASSERT_TRUE(GivesResults()) << Err();
  for (int i = 0; i < 3; ++i) {
    for (const char* program : {"kinect_source", "plane_filter", "feature_estimator",
                                "hough_segmenter", "model_verifier", "object_exporter"}) {
      const pid_t killed = Find(program);
      ASSERT_GT(killed, 0) << program << Err();
      kill(killed, SIGKILL);
      ASSERT_TRUE(IsBack(program, killed)) << program << Err();
      ASSERT_TRUE(GivesResults()) << program << Err();
    }
    const pid_t killed = Find("lcm-logger");
    ASSERT_GT(killed, 0) << Err();
    kill(killed, SIGKILL);
    ASSERT_TRUE(Records(i + 1)) << Err();
  }
  launcher_->Signal(SIGKILL);
  launcher_->Wait();
  EXPECT_TRUE(Eventually([this] { return ProcessesWith(folder_.Path("")).empty(); }));
}

}  // namespace
}  // namespace declutter
