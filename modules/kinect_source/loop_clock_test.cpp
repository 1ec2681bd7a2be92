#include "modules/kinect_source/loop_clock.h"

#include <gtest/gtest.h>

namespace declutter {
namespace {

constexpr int64_t kPeriod_us = 100;

TEST(LoopClockTest, LeavesTheTimeOfTheFirstLoop) {
  LoopClock clock(kPeriod_us);
  EXPECT_EQ(clock.At(LoopClock::kDepth, 1, 7).device_us, 7);
  EXPECT_EQ(clock.At(LoopClock::kDepth, 2, 107).device_us, 107);
  EXPECT_EQ(clock.At(LoopClock::kDepth, 2, 107).loop, 1);
}

TEST(LoopClockTest, GoesOnAPeriodAfterTheLastFrame) {
  LoopClock clock(kPeriod_us);
  clock.At(LoopClock::kDepth, 1, 0);
  clock.At(LoopClock::kDepth, 2, 90);
  EXPECT_EQ(clock.At(LoopClock::kDepth, 1, 0).device_us, 190);
  EXPECT_EQ(clock.At(LoopClock::kDepth, 2, 90).device_us, 280);
  const LoopClock::Time third = clock.At(LoopClock::kDepth, 1, 0);
  EXPECT_EQ(third.loop, 2);
  EXPECT_EQ(third.device_us, 380);
}

TEST(LoopClockTest, RepeatsASingleFrame) {
  LoopClock clock(kPeriod_us);
  for (int64_t i = 0; i < 4; ++i) {
    EXPECT_EQ(clock.At(LoopClock::kDepth, 1, 0).device_us, i * kPeriod_us);
  }
}

TEST(LoopClockTest, ShiftsBothStreamsAlikeWhicheverBeginsFirst) {
  for (const bool color_first : {false, true}) {
    LoopClock clock(kPeriod_us);
    clock.At(LoopClock::kDepth, 1, 0);
    clock.At(LoopClock::kColor, 1, 3);
    clock.At(LoopClock::kDepth, 2, 100);
    clock.At(LoopClock::kColor, 2, 103);
    int64_t color_us = color_first ? clock.At(LoopClock::kColor, 1, 3).device_us : 0;
    EXPECT_EQ(clock.At(LoopClock::kDepth, 1, 0).device_us, 203);
    if (!color_first) color_us = clock.At(LoopClock::kColor, 1, 3).device_us;
    EXPECT_EQ(color_us, 206);
  }
}

}  // namespace
}  // namespace declutter
