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
