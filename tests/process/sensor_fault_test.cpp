#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "tests/process/sensor_run.h"

namespace declutter {
namespace {

using ::testing::HasSubstr;

using SensorFaultTest = SensorRun;

TEST_F(SensorFaultTest, SurvivesBeingUnpluggedAgainAndAgain) {
  const std::string sensor =
      WriteSensor("fault { kind: \"unplug\" begin: 30 num_periods: 45 } repeat_after: 75");
  const int num_cycles = ShortOrSoak(3, 100);
  const Outcome outcome =
      Run(Live(sensor), "warm_up_frames: 0 num_frames: " + std::to_string(30 * num_cycles));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const SensorLog log = ReadLog();
  int num_gaps = 0;
  double longest_gap_s = 0, latest_report_s = 0;
  for (size_t i = 1; i < log.depth.size(); ++i) {
    const int64_t gap_us = log.depth[i].header.utime - log.depth[i - 1].header.utime;
    EXPECT_GT(gap_us, 0);
    if (gap_us < 1'000'000) continue;
    ++num_gaps;
    longest_gap_s = std::max(longest_gap_s, 1e-6 * static_cast<double>(gap_us));
    const int64_t lost_us = log.depth_logged_us[i - 1];
    const auto reported = std::find_if(
        log.statuses.begin(), log.statuses.end(), [lost_us](const SensorLog::Status& status) {
          return status.logged_us > lost_us &&
                 status.content.message.find("no sensor") != std::string::npos;
        });
    ASSERT_NE(reported, log.statuses.end());
    const double report_s = 1e-6 * static_cast<double>(reported->logged_us - lost_us);
    EXPECT_LT(report_s, 2);
    latest_report_s = std::max(latest_report_s, report_s);
  }
  EXPECT_GE(num_gaps, num_cycles);
  std::printf("unplugged %d times for 1.5 s: reported within %.2f s, frames again after %.2f s\n",
              num_gaps, latest_report_s, longest_gap_s);
  EXPECT_EQ(log.statuses.back().content.message, "");
}

TEST_F(SensorFaultTest, OpensASensorAgainThatStalls) {
  const std::string sensor = WriteSensor("fault { kind: \"stall\" begin: 20 num_periods: 60 }");
  const Outcome outcome = Run(Live(sensor), "num_frames: 40");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("no sensor: it sends no frames"));
  EXPECT_THAT(outcome.err, HasSubstr("all is well again"));
  EXPECT_GE(ReadLog().depth.size(), 35u);
}

TEST_F(SensorFaultTest, LeavesOutDamagedFramesAndCountsLostOnes) {
  const std::string sensor = WriteSensor(
      "fault { kind: \"corrupt\" begin: 15 num_periods: 4 }"
      "fault { kind: \"drop\" begin: 25 num_periods: 3 }");
  const Outcome outcome = Run(Live(sensor), "num_frames: 40");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("byte are no image of 320x240 px"));
  const SensorLog log = ReadLog();
  EXPECT_GE(log.statuses.back().content.num_rejected, 1);
  EXPECT_GE(log.statuses.back().content.num_skipped, 3);
  const std::vector<uint16_t> rendered = Rendered(sensor).depth.at(0).counts;
  for (const DepthFrame& frame : log.depth) EXPECT_EQ(frame.image.counts, rendered);
}

TEST_F(SensorFaultTest, TimeGoesOnWhateverTheTimestamps) {
  const std::string sensor = WriteSensor(
      "fault { kind: \"wrong_time\" begin: 15 num_periods: 10 time_shift_s: -5 }"
      "fault { kind: \"wrong_time\" begin: 30 num_periods: 10 time_shift_s: 3600 }");
  const Outcome outcome = Run(Live(sensor), "num_frames: 50");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const SensorLog log = ReadLog();
  for (size_t i = 1; i < log.depth.size(); ++i) {
    EXPECT_GT(log.depth[i].header.utime, log.depth[i - 1].header.utime);
    EXPECT_LT(std::abs(log.depth[i].header.utime - log.depth_logged_us[i]), 2'000'000);
  }
}

TEST_F(SensorFaultTest, SaysThatTheSensorMeasuresNothing) {
  const std::string sensor = WriteSensor("fault { kind: \"zero\" begin: 10 num_periods: 60 }");
  const Outcome outcome = Run(Live(sensor), "num_frames: 80");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("the sensor measures nothing"));
  EXPECT_THAT(outcome.err, HasSubstr("all is well again"));
}

}  // namespace
}  // namespace declutter
