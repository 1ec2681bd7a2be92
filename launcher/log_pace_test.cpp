#include "launcher/log_pace.h"

#include <gtest/gtest.h>

#include <cmath>

namespace declutter::launcher {
namespace {

TEST(LogPace, RunsAtItsSpeed) {
  const LogPace pace(2.0, 100.0);
  EXPECT_DOUBLE_EQ(pace.Wait(0.0, 100.0), 0.0);
  EXPECT_DOUBLE_EQ(pace.Wait(3.0, 100.0), 1.5);
  EXPECT_DOUBLE_EQ(pace.Wait(3.0, 101.0), 0.5);
  EXPECT_DOUBLE_EQ(pace.Wait(3.0, 102.0), 0.0);
}

TEST(LogPace, StandsStillAndGoesOnWhereItStood) {
  LogPace pace(1.0, 0.0);
  pace.Toggle(2.0);
  EXPECT_TRUE(pace.stands_still());
  EXPECT_DOUBLE_EQ(pace.Wait(2.0, 50.0), 0.0);
  EXPECT_TRUE(std::isinf(pace.Wait(2.5, 50.0)));
  pace.Toggle(50.0);
  EXPECT_DOUBLE_EQ(pace.Wait(2.5, 50.0), 0.5);
}

TEST(LogPace, StepsOnlyWhileItStandsStill) {
  LogPace pace(1.0, 0.0);
  pace.StepTo(7.0);
  EXPECT_DOUBLE_EQ(pace.Wait(7.0, 0.0), 7.0);
  pace.Toggle(1.0);
  pace.StepTo(7.0);
  EXPECT_DOUBLE_EQ(pace.Wait(7.0, 1.0), 0.0);
  EXPECT_TRUE(std::isinf(pace.Wait(7.1, 1.0)));
  pace.Toggle(1.0);
  EXPECT_NEAR(pace.Wait(7.1, 1.0), 0.1, 1e-9);
}

}  // namespace
}  // namespace declutter::launcher
