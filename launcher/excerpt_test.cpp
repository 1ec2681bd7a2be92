#include "launcher/excerpt.h"

#include <gtest/gtest.h>

#include "modules/runtime/config_error.h"

namespace declutter::launcher {
namespace {

TEST(Excerpt, HoldsChannelsAndTimes) {
  Excerpt excerpt;
  EXPECT_TRUE(excerpt.Holds("OBJECTS", 0.0));
  excerpt.start_s = 1.0;
  excerpt.end_s = 2.0;
  excerpt.channels = {"OBJECTS"};
  EXPECT_FALSE(excerpt.Holds("OBJECTS", 0.999));
  EXPECT_TRUE(excerpt.Holds("OBJECTS", 1.0));
  EXPECT_TRUE(excerpt.Holds("OBJECTS", 2.0));
  EXPECT_FALSE(excerpt.Holds("OBJECTS", 2.001));
  EXPECT_FALSE(excerpt.Holds("TABLETOP", 1.5));
}

TEST(Excerpt, TakesNumbersFromAMinimum) {
  EXPECT_DOUBLE_EQ(ParseNumber("2.5", 0.0), 2.5);
  for (const char* text : {"", "fast", "2x", "-1", "nan"}) {
    EXPECT_THROW(ParseNumber(text, 0.0), runtime::ConfigError) << text;
  }
}

}  // namespace
}  // namespace declutter::launcher
