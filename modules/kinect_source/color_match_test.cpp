#include "modules/kinect_source/color_match.h"

#include <gtest/gtest.h>

namespace declutter {
namespace {

constexpr int64_t kPeriod_us = 33'333;

SensorFrame Depth(int64_t device_us) {
  SensorFrame frame;
  frame.device_us = device_us;
  return frame;
}

ColorImage Color(uint8_t gray) { return {1, 1, {gray, gray, gray}}; }

TEST(ColorMatchTest, WaitsForTheColourOfTheSameTime) {
  ColorMatch match(kPeriod_us);
  EXPECT_FALSE(match.AddDepth(Depth(100'000)));
  EXPECT_FALSE(match.Take());
  match.AddColor(66'667, Color(1));
  EXPECT_FALSE(match.Take());
  match.AddColor(101'000, Color(2));
  const auto frame = match.Take();
  ASSERT_TRUE(frame && frame->color);
  EXPECT_EQ(frame->color->rgb[0], 2);
  EXPECT_FALSE(match.is_waiting());
}

TEST(ColorMatchTest, TakesColourThatCameFirst) {
  ColorMatch match(kPeriod_us);
  match.AddColor(99'000, Color(1));
  match.AddDepth(Depth(100'000));
  const auto frame = match.Take();
  ASSERT_TRUE(frame && frame->color);
}

TEST(ColorMatchTest, TakesTheNearerOfTwo) {
  ColorMatch match(kPeriod_us);
  match.AddColor(90'000, Color(1));
  match.AddColor(104'000, Color(2));
  match.AddDepth(Depth(100'000));
  EXPECT_EQ(match.Take()->color->rgb[0], 2);
}

TEST(ColorMatchTest, GivesUpWhenOnlyLaterColourComes) {
  ColorMatch match(kPeriod_us);
  match.AddDepth(Depth(100'000));
  match.AddColor(133'333, Color(1));
  const auto frame = match.Take();
  ASSERT_TRUE(frame);
  EXPECT_FALSE(frame->color);
}

TEST(ColorMatchTest, ANewerDepthImagePushesOutTheOneThatWaits) {
  ColorMatch match(kPeriod_us);
  EXPECT_FALSE(match.AddDepth(Depth(100'000)));
  const auto before = match.AddDepth(Depth(133'333));
  ASSERT_TRUE(before);
  EXPECT_EQ(before->device_us, 100'000);
  EXPECT_EQ(match.TakeAnyhow()->device_us, 133'333);
}

}  // namespace
}  // namespace declutter
