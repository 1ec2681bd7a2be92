#include "modules/runtime/inbox.h"

#include <gtest/gtest.h>

#include <thread>

namespace declutter::runtime {
namespace {

using std::chrono::steady_clock;

TEST(Inbox, ReplacesTheWaitingFrameByANewerOneAtTheSensorsRate) {
  Inbox inbox(false, 8);
  EXPECT_TRUE(inbox.Put({0, 1, {}}));
  EXPECT_FALSE(inbox.Put({0, 2, {}}));
  EXPECT_EQ(inbox.Take()->utime, 2);
  EXPECT_FALSE(inbox.Take());
}

TEST(Inbox, DoesNotCountAFrameSentAgainAsSkipped) {
  Inbox inbox(false, 8);
  inbox.Put({0, 1, {}});
  EXPECT_TRUE(inbox.Put({0, 1, {}}));
  EXPECT_EQ(inbox.size(), 1u);
}

TEST(Inbox, GivesEverySubscriptionItsTurn) {
  Inbox inbox(false, 8);
  inbox.Put({0, 1, {}});
  inbox.Put({1, 1, {}});
  inbox.Put({0, 2, {}});
  EXPECT_EQ(inbox.Take()->subscription, 0u);
  EXPECT_EQ(inbox.Take()->subscription, 1u);
}

TEST(Inbox, KeepsEveryFrameInOrderWhenLossless) {
  Inbox inbox(true, 8);
  for (int i = 0; i < 8; ++i) EXPECT_TRUE(inbox.Put({0, i, {}}));
  for (int i = 0; i < 8; ++i) EXPECT_EQ(inbox.Take()->utime, i);
}

TEST(Inbox, SaysWhenAFullLosslessInboxLosesAFrame) {
  Inbox inbox(true, 1);
  EXPECT_TRUE(inbox.Put({0, 1, {}}));
  EXPECT_FALSE(inbox.Put({0, 2, {}}));
  EXPECT_EQ(inbox.Take()->utime, 1);
}

TEST(Inbox, IsEmptiedAfterClosingWhenLossless) {
  Inbox inbox(true, 8);
  inbox.Put({0, 1, {}});
  inbox.Close();
  EXPECT_TRUE(inbox.TakeUntil(steady_clock::now()));
  EXPECT_FALSE(inbox.TakeUntil(steady_clock::now()));
}

TEST(Inbox, DropsWhatWaitsAtClosingAtTheSensorsRate) {
  Inbox inbox(false, 8);
  inbox.Put({0, 1, {}});
  inbox.Close();
  EXPECT_FALSE(inbox.TakeUntil(steady_clock::now()));
}

TEST(Inbox, GivesTheWorkerWhatItsPredecessorHasNotHandled) {
  for (const bool lossless : {false, true}) {
    Inbox inbox(lossless, 8);
    inbox.Hold();
    for (int i = 1; i <= 5; ++i) EXPECT_TRUE(inbox.Put({0, i, {}}));
    EXPECT_TRUE(inbox.Put({0, 5, {}}));
    EXPECT_EQ(inbox.size(), 5u);
    inbox.Release(2);
    EXPECT_TRUE(inbox.Put({0, 6, {}}));
    for (int i = 3; i <= 6; ++i) EXPECT_EQ(inbox.Take()->utime, i);
    EXPECT_FALSE(inbox.Take());
  }
}

TEST(Inbox, ReplacesOnlyWhatCameAfterTheReleaseAtTheSensorsRate) {
  Inbox inbox(false, 8);
  inbox.Hold();
  for (int i = 1; i <= 2; ++i) inbox.Put({0, i, {}});
  inbox.Release(0);
  EXPECT_TRUE(inbox.Put({0, 3, {}}));
  EXPECT_FALSE(inbox.Put({0, 4, {}}));
  for (const int utime : {1, 2, 4}) EXPECT_EQ(inbox.Take()->utime, utime);
}

TEST(Inbox, HoldsNoMoreThanItsBoundAndKeepsTheNewest) {
  Inbox inbox(false, 8);
  inbox.Hold();
  constexpr int kNum = static_cast<int>(Inbox::kMaxHeld);
  for (int i = 1; i <= kNum; ++i) EXPECT_TRUE(inbox.Put({0, i, {}}));
  EXPECT_FALSE(inbox.Put({0, kNum + 1, {}}));
  inbox.Release(0);
  EXPECT_EQ(inbox.Take()->utime, 2);
}

TEST(Inbox, WakesWhoAwaitsTheReleaseAlsoToEnd) {
  Inbox released(false, 8), closed(false, 8);
  released.Hold();
  closed.Hold();
  std::thread other([&] {
    released.Release(0);
    closed.Close();
  });
  released.AwaitRelease();
  closed.AwaitRelease();
  other.join();
  EXPECT_FALSE(released.closed());
  EXPECT_TRUE(closed.closed());
}

TEST(Inbox, WakesTheWorker) {
  Inbox inbox(false, 8);
  std::thread sender([&inbox] { inbox.Put({0, 5, {}}); });
  const std::optional<Delivery> delivery =
      inbox.TakeUntil(steady_clock::now() + std::chrono::seconds(60));
  sender.join();
  ASSERT_TRUE(delivery);
  EXPECT_EQ(delivery->utime, 5);
}

TEST(Inbox, WakesTheWorkerToEnd) {
  Inbox inbox(false, 8);
  std::thread closer([&inbox] { inbox.Close(); });
  EXPECT_FALSE(inbox.TakeUntil(steady_clock::now() + std::chrono::seconds(60)));
  closer.join();
  EXPECT_TRUE(inbox.closed());
}

}  // namespace
}  // namespace declutter::runtime
