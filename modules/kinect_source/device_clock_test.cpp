#include "modules/kinect_source/device_clock.h"

#include <gtest/gtest.h>

namespace declutter {
namespace {

constexpr int64_t kStart_us = 1'700'000'000'000'000;
constexpr int64_t kPeriod_us = 33'333;

TEST(DeviceClockTest, TheFirstFrameWasTakenWhenItArrived) {
  EXPECT_EQ(DeviceClock().ToUtime(5, kStart_us), kStart_us);
}

TEST(DeviceClockTest, TheSensorsClockCountsAndNotTheArrival) {
  DeviceClock clock;
  int64_t last = clock.ToUtime(0, kStart_us);
  for (int64_t i = 1; i < 100; ++i) {
    const int64_t late_us = i % 3 * 4000;
    const int64_t utime = clock.ToUtime(i * kPeriod_us, kStart_us + i * kPeriod_us + late_us);
    EXPECT_NEAR(static_cast<double>(utime - last), kPeriod_us, 20);
    last = utime;
  }
}

TEST(DeviceClockTest, FollowsASensorWhoseClockIsSlow) {
  DeviceClock clock;
  int64_t utime = 0, arrival_us = 0;
  for (int64_t i = 0; i < 30'000; ++i) {  // 1000 s, 100 ppm
    arrival_us = kStart_us + i * kPeriod_us;
    utime = clock.ToUtime(i * kPeriod_us * 9999 / 10'000, arrival_us);
  }
  EXPECT_NEAR(static_cast<double>(utime), static_cast<double>(arrival_us), 5000);
}

TEST(DeviceClockTest, NeverGoesBackWhateverTheTimestamps) {
  DeviceClock clock;
  const int64_t device_us[] = {0, 33'333, -5'000'000, -4'966'667, 90'000'000, 90'000'000, 100};
  int64_t last = 0;
  for (int64_t i = 0; i < 7; ++i) {
    const int64_t arrival_us = kStart_us + i * kPeriod_us;
    const int64_t utime = clock.ToUtime(device_us[i], arrival_us);
    EXPECT_GT(utime, last);
    EXPECT_NEAR(static_cast<double>(utime), static_cast<double>(arrival_us), 40'000);
    last = utime;
  }
  EXPECT_EQ(clock.num_jumps(), 4);
}

TEST(DeviceClockTest, GoesOnAfterTheDeviceWasOpenedAgain) {
  DeviceClock clock;
  const int64_t before = clock.ToUtime(70'000'000, kStart_us);
  clock.Restart();
  EXPECT_EQ(clock.ToUtime(0, kStart_us + kPeriod_us), before + kPeriod_us);
  EXPECT_EQ(clock.num_jumps(), 0);
}

TEST(DeviceClockTest, TellsTheJitterOfArrivals) {
  DeviceClock clock;
  for (int64_t i = 0; i < 1001; ++i) {
    clock.ToUtime(i * kPeriod_us, kStart_us + i * kPeriod_us + (i % 2) * 3000);
  }
  EXPECT_NEAR(clock.jitter_us(), 3000, 1);
}

}  // namespace
}  // namespace declutter
