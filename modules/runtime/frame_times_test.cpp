#include "modules/runtime/frame_times.h"

#include <gtest/gtest.h>

namespace declutter::runtime {
namespace {

TEST(FrameTimes, TellsTheMedianAndTheLongestOfWhatHasEndedSinceItWasAsked) {
  FrameTimes times;
  for (int utime = 1; utime <= 5; ++utime) times.Begin(utime, 0.0);
  times.End(1, 10.0);
  times.End(3, 70.0);
  times.End(2, 30.0);
  const FrameTimes::Latency first = times.Take();
  EXPECT_EQ(first.median_ms, 30.0);
  EXPECT_EQ(first.max_ms, 70.0);
  times.End(4, 90.0);
  EXPECT_EQ(times.Take().median_ms, 90.0);
  EXPECT_EQ(times.Take().median_ms, 0.0);
}

TEST(FrameTimes, CountsFromTheFirstPartOfAFrame) {
  FrameTimes times;
  times.Begin(7, 1.0);
  times.Begin(7, 4.0);
  times.End(7, 6.0);
  EXPECT_EQ(times.Take().max_ms, 5.0);
}

TEST(FrameTimes, BeginsAfreshWhenATimeComesAgain) {
  FrameTimes times;
  times.Begin(7, 1.0);
  times.End(7, 2.0);
  times.End(7, 100.0);
  times.Begin(7, 1000.0);
  times.End(7, 1003.0);
  EXPECT_EQ(times.Take().max_ms, 3.0);
}

TEST(FrameTimes, ForgetsTheOldestOfTheFramesThatNeverEnd) {
  FrameTimes times;
  for (int utime = 0; utime < 1000; ++utime) times.Begin(utime, utime);
  times.End(0, 2000.0);
  EXPECT_EQ(times.Take().max_ms, 0.0);
  times.End(999, 2000.0);
  EXPECT_EQ(times.Take().max_ms, 1001.0);
}

}  // namespace
}  // namespace declutter::runtime
