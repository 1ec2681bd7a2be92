#include "modules/synthetic_sensor/fault_schedule.h"

#include <gtest/gtest.h>

#include "modules/runtime/config.h"

namespace declutter {
namespace {

SyntheticSensor Sensor(const std::string& faults) {
  SyntheticSensor sensor;
  runtime::ParseConfig("scene: \"a.textproto\" " + faults, "sensor.textproto", &sensor);
  return sensor;
}

TEST(FaultScheduleTest, DeliversAllFramesOfASensorWithoutFaults) {
  const SensorPeriod period = PeriodOf(Sensor(""), 1000);
  EXPECT_TRUE(period.is_plugged);
  EXPECT_TRUE(period.has_frame);
  EXPECT_FALSE(period.is_lost || period.is_corrupt || period.is_zero);
  EXPECT_EQ(period.time_shift_us, 0);
}

TEST(FaultScheduleTest, AFaultLastsItsPeriods) {
  const SyntheticSensor sensor = Sensor("fault { kind: \"unplug\" begin: 3 num_periods: 2 }");
  EXPECT_TRUE(PeriodOf(sensor, 2).is_plugged);
  EXPECT_FALSE(PeriodOf(sensor, 3).is_plugged);
  EXPECT_FALSE(PeriodOf(sensor, 4).has_frame);
  EXPECT_TRUE(PeriodOf(sensor, 5).is_plugged);
}

TEST(FaultScheduleTest, ASensorThatStallsStaysPlugged) {
  const SensorPeriod period = PeriodOf(Sensor("fault { kind: \"stall\" }"), 0);
  EXPECT_TRUE(period.is_plugged);
  EXPECT_FALSE(period.has_frame);
}

TEST(FaultScheduleTest, FaultsAddUp) {
  const SyntheticSensor sensor = Sensor(
      "fault { kind: \"zero\" } fault { kind: \"corrupt\" } fault { kind: \"drop\" }"
      "fault { kind: \"wrong_time\" time_shift_s: -0.25 }");
  const SensorPeriod period = PeriodOf(sensor, 0);
  EXPECT_TRUE(period.has_frame && period.is_zero && period.is_corrupt && period.is_lost);
  EXPECT_EQ(period.time_shift_us, -250000);
}

TEST(FaultScheduleTest, FaultsComeAgainWhenAsked) {
  const SyntheticSensor sensor = Sensor("fault { kind: \"unplug\" begin: 1 } repeat_after: 3");
  EXPECT_TRUE(PeriodOf(sensor, 3).is_plugged);
  EXPECT_FALSE(PeriodOf(sensor, 4).is_plugged);
  EXPECT_FALSE(PeriodOf(sensor, 7).is_plugged);
}

}  // namespace
}  // namespace declutter
