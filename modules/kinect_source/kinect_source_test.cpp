#include "modules/kinect_source/kinect_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace declutter {
namespace {

using ::testing::HasSubstr;

constexpr auto kRecording = KinectSource::Input::kRecording;
constexpr auto kSensor = KinectSource::Input::kSensor;

KinectSourceConfig Config() {
  KinectSourceConfig config;
  config.set_rate_hz(10);
  config.set_result_timeout_s(3);
  config.set_max_tries(2);
  return config;
}

RecordedFrame Frame(int64_t utime) {
  RecordedFrame frame;
  frame.depth.header = {utime, "frame" + std::to_string(utime), ""};
  frame.depth.image.counts = {1};
  frame.color = ColorImage{1, 1, {1, 2, 3}};
  return frame;
}

// Gives frames with utime 0, 1, ... num_frames - 1.
KinectSource::ReadFrame Frames(int num_frames) {
  return [num_frames, next = 0]() mutable {
    ReadResult result;
    result.at_end = next == num_frames;
    if (!result.at_end) result.frame = Frame(next++);
    return result;
  };
}

// utime of what is published, -1 for nothing.
int64_t UtimeOf(const KinectSource::Step& step) {
  return step.publish == nullptr ? -1 : step.publish->depth.header.utime;
}

TEST(KinectSourceTest, WaitsForTheResultBeforeTheNextFrame) {
  KinectSource source(Config(), true, kRecording, Frames(2));
  EXPECT_EQ(UtimeOf(source.Advance(100)), 0);
  const auto waiting = source.Advance(101);
  EXPECT_EQ(UtimeOf(waiting), -1);
  EXPECT_EQ(waiting.wait_s, 2.0);
  source.OnResult(0);
  EXPECT_EQ(UtimeOf(source.Advance(101)), 1);
}

TEST(KinectSourceTest, IgnoresResultsOfOtherFrames) {
  KinectSource source(Config(), true, kRecording, Frames(2));
  source.OnResult(0);
  EXPECT_EQ(UtimeOf(source.Advance(100)), 0);
  source.OnResult(7);
  EXPECT_EQ(UtimeOf(source.Advance(100)), -1);
}

TEST(KinectSourceTest, EndsWhenTheLastResultIsOut) {
  KinectSource source(Config(), true, kRecording, Frames(1));
  EXPECT_EQ(UtimeOf(source.Advance(100)), 0);
  EXPECT_TRUE(source.Advance(100).wait_s);
  source.OnResult(0);
  const auto last = source.Advance(100);
  EXPECT_EQ(UtimeOf(last), -1);
  EXPECT_EQ(last.failure, "");
  EXPECT_FALSE(last.wait_s);
}

TEST(KinectSourceTest, EndsAtOnceWithoutFrames) {
  KinectSource source(Config(), true, kRecording, Frames(0));
  EXPECT_FALSE(source.Advance(100).wait_s);
}

TEST(KinectSourceTest, SendsAFrameAgainAfterTheTimeout) {
  KinectSource source(Config(), true, kRecording, Frames(1));
  source.Advance(100);
  EXPECT_EQ(UtimeOf(source.Advance(102.9)), -1);
  const auto again = source.Advance(103);
  EXPECT_EQ(UtimeOf(again), 0);
  EXPECT_EQ(again.failure, "");
  EXPECT_FALSE(again.publish->depth.image.empty());
  EXPECT_TRUE(again.publish->color);
  EXPECT_EQ(UtimeOf(source.Advance(105.9)), -1);
}

TEST(KinectSourceTest, SendsAnErrorForAFrameWithoutResult) {
  KinectSource source(Config(), true, kRecording, Frames(2));
  source.Advance(100);
  source.Advance(103);
  const auto error = source.Advance(106);
  ASSERT_EQ(UtimeOf(error), 0);
  EXPECT_EQ(error.publish->depth.header.error, "no result after 2 tries");
  EXPECT_TRUE(error.publish->depth.image.empty());
  EXPECT_FALSE(error.publish->color);
  EXPECT_THAT(error.failure, HasSubstr("frame0: no result after 2 tries"));
  source.OnResult(0);
  EXPECT_EQ(UtimeOf(source.Advance(107)), 1);
}

TEST(KinectSourceTest, GoesOnWhenEvenTheErrorHasNoResult) {
  KinectSource source(Config(), true, kRecording, Frames(2));
  source.Advance(100);
  source.Advance(103);
  source.Advance(106);
  const auto lost = source.Advance(109);
  EXPECT_EQ(UtimeOf(lost), -1);
  EXPECT_THAT(lost.failure, HasSubstr("frame0: lost"));
  EXPECT_EQ(UtimeOf(source.Advance(109)), 1);
}

TEST(KinectSourceTest, ReportsAnUnreadableFrameAndSendsIt) {
  auto frame = Frame(0);
  frame.depth.header.error = "depth.png: truncated PNG";
  KinectSource source(Config(), true, kRecording, [&] { return ReadResult{frame}; });
  const auto step = source.Advance(100);
  EXPECT_EQ(UtimeOf(step), 0);
  EXPECT_EQ(step.failure, "frame0: depth.png: truncated PNG");
}

TEST(KinectSourceTest, ReportsUnusableColourAndSendsTheFrame) {
  auto frame = Frame(0);
  frame.color_error = "rgb.png: truncated PNG";
  KinectSource source(Config(), true, kRecording, [&] { return ReadResult{frame}; });
  const auto step = source.Advance(100);
  EXPECT_EQ(UtimeOf(step), 0);
  EXPECT_EQ(step.failure, "frame0: rgb.png: truncated PNG");
}

TEST(KinectSourceTest, KeepsItsRateWithoutWaitingForResults) {
  KinectSource source(Config(), false, kRecording, Frames(3));
  EXPECT_EQ(UtimeOf(source.Advance(100)), 0);
  const auto early = source.Advance(100.04);
  EXPECT_EQ(UtimeOf(early), -1);
  EXPECT_NEAR(early.wait_s.value(), 0.06, 1e-9);
  EXPECT_EQ(UtimeOf(source.Advance(100.13)), 1);
  // Being late once does not shift what follows.
  EXPECT_NEAR(source.Advance(100.13).wait_s.value(), 0.07, 1e-9);
}

TEST(KinectSourceTest, DoesNotCatchUpInABurst) {
  KinectSource source(Config(), false, kRecording, Frames(3));
  source.Advance(100);
  EXPECT_EQ(UtimeOf(source.Advance(105)), 1);
  EXPECT_NEAR(source.Advance(105).wait_s.value(), 0.1, 1e-9);
}

TEST(KinectSourceTest, WaitsForTheLastResultAtARateToo) {
  KinectSource source(Config(), false, kRecording, Frames(1));
  source.Advance(100);
  EXPECT_EQ(source.Advance(101).wait_s, 2.0);
  source.OnResult(0);
  EXPECT_FALSE(source.Advance(101).wait_s);
}

TEST(KinectSourceTest, EndsAtARateWithoutTheLastResult) {
  KinectSource source(Config(), false, kRecording, Frames(1));
  source.Advance(100);
  const auto last = source.Advance(103);
  EXPECT_EQ(UtimeOf(last), -1);
  EXPECT_EQ(last.failure, "");
  EXPECT_FALSE(last.wait_s);
}

TEST(KinectSourceTest, PlaysARecordingAsItWasTaken) {
  KinectSourceConfig config = Config();
  config.set_rate_hz(0);
  auto frames = [next = 0]() mutable { return ReadResult{Frame(next++ * 200'000)}; };
  KinectSource source(config, false, kRecording, frames);
  EXPECT_EQ(UtimeOf(source.Advance(100)), 0);
  EXPECT_NEAR(source.Advance(100.05).wait_s.value(), 0.15, 1e-9);
  EXPECT_EQ(UtimeOf(source.Advance(100.2)), 200'000);
}

TEST(KinectSourceTest, EndsAfterTheNumberOfFramesAskedFor) {
  KinectSourceConfig config = Config();
  config.set_num_frames(1);
  KinectSource source(config, true, kRecording, Frames(5));
  EXPECT_EQ(UtimeOf(source.Advance(100)), 0);
  source.OnResult(0);
  EXPECT_FALSE(source.Advance(100).wait_s);
}

TEST(KinectSourceTest, SendsTheFramesOfASensorWhenTheyCome) {
  std::optional<RecordedFrame> newest;
  const auto read = [&newest] { return ReadResult{std::exchange(newest, std::nullopt), 0.02}; };
  KinectSource source(Config(), false, kSensor, read);
  EXPECT_EQ(source.Advance(100).wait_s, 0.02);
  newest = Frame(5);
  EXPECT_EQ(UtimeOf(source.Advance(100.001)), 5);
  newest = Frame(6);
  EXPECT_EQ(UtimeOf(source.Advance(100.002)), 6);
}

TEST(KinectSourceTest, InALosslessRunReadsASensorOnlyWhenTheResultIsThere) {
  int num_read = 0;
  const auto read = [&num_read] { return ReadResult{Frame(num_read++)}; };
  KinectSource source(Config(), true, kSensor, read);
  EXPECT_EQ(UtimeOf(source.Advance(100)), 0);
  EXPECT_EQ(UtimeOf(source.Advance(101)), -1);
  EXPECT_EQ(num_read, 1);
  source.OnResult(0);
  EXPECT_EQ(UtimeOf(source.Advance(101)), 1);
}

}  // namespace
}  // namespace declutter
