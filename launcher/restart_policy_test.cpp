#include "launcher/restart_policy.h"

#include <gtest/gtest.h>

#include "launcher/hang_watch.h"

namespace declutter::launcher {
namespace {

TEST(BackoffTest, DoublesTheDelayUpToTheLongest) {
  Backoff backoff({RestartRule::When::kOnFailure, 0.5, 3.0, 5});
  EXPECT_EQ(backoff.Next(0.0), 0.5);
  EXPECT_EQ(backoff.Next(0.0), 1.0);
  EXPECT_EQ(backoff.Next(0.0), 2.0);
  EXPECT_EQ(backoff.Next(0.0), 3.0);
  EXPECT_EQ(backoff.Next(0.0), 3.0);
}

TEST(BackoffTest, GivesUpAfterTooManyInARow) {
  Backoff backoff({RestartRule::When::kOnFailure, 0.5, 3.0, 2});
  backoff.Next(0.0);
  backoff.Next(4.9);
  EXPECT_EQ(backoff.Next(9.9), std::nullopt);
}

TEST(BackoffTest, StartsAnewAfterARunTenTimesAsLongAsTheDelay) {
  Backoff backoff({RestartRule::When::kOnFailure, 0.5, 3.0, 2});
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(backoff.Next(5.0), 0.5);
    EXPECT_EQ(backoff.Next(4.9), 1.0);
    EXPECT_EQ(backoff.Next(10.0), 0.5);
  }
}

TEST(HangWatchTest, IsStuckWhenNoFrameIsFinishedWhileOneWaits) {
  HangWatch watch(3.0);
  watch.Start(10.0);
  watch.Beat(5, true, 11.0);
  for (double t = 12.0; t <= 14.0; t += 1.0) watch.Beat(5, true, t);
  EXPECT_FALSE(watch.is_stuck(14.0));
  EXPECT_TRUE(watch.is_stuck(14.1));
  EXPECT_FALSE(watch.is_silent(14.1));
}

TEST(HangWatchTest, IsNotStuckWhileIdleOrWhileFramesAreFinished) {
  HangWatch watch(3.0);
  watch.Start(0.0);
  for (int t = 1; t < 20; ++t) {
    watch.Beat(0, false, t);
    EXPECT_FALSE(watch.is_stuck(t + 0.5));
  }
  for (int t = 20; t < 40; ++t) {
    watch.Beat(t, true, t);
    EXPECT_FALSE(watch.is_stuck(t + 0.5));
  }
}

TEST(HangWatchTest, IsSilentWithoutASignOfLife) {
  HangWatch watch(3.0);
  watch.Start(0.0);
  watch.Beat(0, false, 1.0);
  EXPECT_FALSE(watch.is_silent(9.0));
  EXPECT_TRUE(watch.is_silent(9.1));
}

TEST(HangWatchTest, NeverFindsFaultWithoutALimit) {
  HangWatch watch(HangWatch::kNever);
  watch.Start(0.0);
  watch.Beat(0, true, 1.0);
  EXPECT_FALSE(watch.is_stuck(1e12) || watch.is_silent(1e12));
}

}  // namespace
}  // namespace declutter::launcher
