#include "modules/runtime/journal.h"

#include <gtest/gtest.h>

namespace declutter::runtime {
namespace {

TEST(LineLimiter, LetsOneLineASecondPerCauseThrough) {
  LineLimiter limiter;
  EXPECT_TRUE(limiter.Admit("lost", 10.0));
  EXPECT_FALSE(limiter.Admit("lost", 10.5));
  EXPECT_FALSE(limiter.Admit("lost", 10.9));
  EXPECT_EQ(limiter.Admit("lost", 11.1), 2);
  EXPECT_EQ(limiter.Admit("lost", 12.2), 0);
}

TEST(LineLimiter, HoldsBackOneCauseWithoutTheOthers) {
  LineLimiter limiter;
  EXPECT_TRUE(limiter.Admit("lost", 10.0));
  EXPECT_TRUE(limiter.Admit("damaged", 10.1));
}

}  // namespace
}  // namespace declutter::runtime
