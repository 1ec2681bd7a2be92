#include "launcher/vitals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "launcher/status_table.h"

namespace declutter::launcher {
namespace {

using testing::ContainsRegex;

module_status_t StatusAt(double time_s, int64_t num_out) {
  module_status_t status = {};
  status.utime = static_cast<int64_t>(1e6 * time_s);
  status.pid = 7;
  status.num_out = num_out;
  return status;
}

TEST(VitalsTest, TellsTheRateOfFramesGivenOut) {
  Vitals vitals;
  vitals.Hear(StatusAt(10.0, 100));
  EXPECT_EQ(vitals.Report().rate_hz(), 0.0);
  vitals.Hear(StatusAt(12.0, 160));
  EXPECT_DOUBLE_EQ(vitals.Report().rate_hz(), 30.0);
}

TEST(VitalsTest, TakesNoRateFromTwoStatusesThatFollowAtOnce) {
  Vitals vitals;
  vitals.Hear(StatusAt(10.0, 100));
  vitals.Hear(StatusAt(11.0, 130));
  vitals.Hear(StatusAt(11.01, 132));
  EXPECT_DOUBLE_EQ(vitals.Report().rate_hz(), 30.0);
}

TEST(VitalsTest, BeginsAfreshWithAnotherProcess) {
  Vitals vitals;
  vitals.Hear(StatusAt(10.0, 100));
  module_status_t other = StatusAt(11.0, 5);
  other.pid = 8;
  vitals.Hear(other);
  EXPECT_EQ(vitals.Report().rate_hz(), 0.0);
}

TEST(VitalsTest, KeepsTheLastComplaintToBeRead) {
  Vitals vitals;
  module_status_t status = StatusAt(10.0, 1);
  status.message = "no sensor";
  vitals.Hear(status);
  vitals.Hear(StatusAt(11.0, 2));
  EXPECT_EQ(vitals.Report().message(), "no sensor");
}

TEST(StatusTableTest, ShowsNoFiguresOfAProcessThatTellsNone) {
  ControlReply reply;
  ProcessStatus* silent = reply.add_process();
  *silent = Vitals().Report();
  silent->set_name("lcm-logger");
  silent->set_state("running");
  Vitals vitals;
  module_status_t status = StatusAt(10.0, 100);
  status.latency_ms = 12.34;
  vitals.Hear(status);
  ProcessStatus* telling = reply.add_process();
  *telling = vitals.Report();
  telling->set_name("plane_filter");
  telling->set_state("running");
  reply.set_place("udpm://here, logs in there");
  const std::string table = StatusTable(reply);
  EXPECT_THAT(table, ContainsRegex("lcm-logger    running( +-| +0| +0:00:00| +0%)+\n"));
  EXPECT_THAT(table, ContainsRegex("plane_filter  running .* 100 +0 +0 +0.0 +- +- +12.3 +-\n"));
  EXPECT_THAT(table, ContainsRegex("\nudpm://here, logs in there\n$"));
}

}  // namespace
}  // namespace declutter::launcher
