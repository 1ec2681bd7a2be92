#include <gmock/gmock.h>

#include "tests/process/control_run.h"

namespace declutter {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsEmpty;

using ControlTest = ControlRun;

TEST_F(ControlTest, ShowsHowEachProcessDoes) {
  Run("", "");
  EXPECT_THAT(Ask({"status"}).out, ContainsRegex("^process +state +pid +restarts"));
  EXPECT_THAT(Row("filter"), ContainsRegex("filter +running +[1-9][0-9]* +0 +0:00:"));
  EXPECT_THAT(Row("lcm-logger"), HasSubstr("running"));
  // A camera of 50 Hz; it knows how long the whole graph takes, the filter only how long it does.
  EXPECT_TRUE(Eventually([this] {
    const double source_ms = Column("source", "latency"), filter_ms = Column("filter", "latency");
    return Column("filter", "Hz") > 25 && Column("filter", "Hz") < 75 && filter_ms > 0 &&
           filter_ms < source_ms;
  })) << Ask({"status"}).out;
  EXPECT_THAT(Ask({"status"}).out, AllOf(HasSubstr("\nudpm://239.255.76.67:"),
                                         HasSubstr(", logs in " + folder_.Path("logs/20"))));
  End();
}

TEST_F(ControlTest, ShowsTheTableAgainEverySecondUntilTheGraphEnds) {
  Run("", "");
  Launched watch({LAUNCHER, "status", "--watch", "--run", folder_.Path("logs/latest")}, asking_);
  const auto num_tables = [this] {
    const std::string text = ReadFile(asking_.Path("stdout"));
    int num = 0;
    for (size_t at = 0; (at = text.find("process ", at)) != std::string::npos; ++at) ++num;
    return num;
  };
  EXPECT_TRUE(Eventually([&] { return num_tables() >= 2; }));
  End();
  EXPECT_EQ(watch.Wait().code, 0);
}

TEST_F(ControlTest, StopsAndStartsAModuleWhileTheRestRuns) {
  Run("", "");
  ASSERT_EQ(Ask({"stop", "filter"}).code, 0);
  EXPECT_THAT(Row("filter"), ContainsRegex("filter +stopped +- "));
  EXPECT_THAT(ModulesOf("fake_filter"), IsEmpty());
  ASSERT_EQ(Ask({"start", "filter"}).code, 0);
  EXPECT_THAT(Row("filter"), ContainsRegex("filter +running +[1-9][0-9]* +1 "));
  End();
}

TEST_F(ControlTest, RestartsAModuleAsAnotherProcess) {
  Run("", "");
  const auto before = ModulesOf("fake_filter");
  ASSERT_EQ(Ask({"restart", "filter"}).code, 0);
  const auto after = ModulesOf("fake_filter");
  ASSERT_EQ(after.size(), 1u);
  EXPECT_NE(before, after);
  End();
}

TEST_F(ControlTest, SaysWhenAModuleDoesNotComeUp) {
  Run("", "required: false " + FilterConfig("mishap: \"crashes\" at_frame: 3"));
  ASSERT_TRUE(Eventually([this] { return Row("filter").find(" ended ") != std::string::npos; }));
  EXPECT_EQ(Ask({"stop", "filter"}).code, 0);
  End();
}

TEST_F(ControlTest, RefusesAModuleThatTheGraphDoesNotHave) {
  Run("", "");
  const Outcome outcome = Ask({"stop", "fliter"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("no module named 'fliter'; did you mean 'filter'?"));
  End();
}

TEST_F(ControlTest, SaysWhenNoGraphRuns) {
  const Outcome outcome = Ask({"status"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("no graph has run there"));
  Run("", "");
  End();
  EXPECT_THAT(Ask({"status"}).err, HasSubstr("no graph runs there"));
}

TEST_F(ControlTest, PrintsWhatAModuleHasSaid) {
  Run("",
      FilterConfig("mishap: \"gets_stuck\" at_frame: 3") + " grace_period_s: 0.2 required: false");
  ASSERT_TRUE(Eventually([this] { return Ask({"logs", "filter"}).out == "filter: stuck\n"; }));
  const Outcome unknown = Ask({"logs", "fliter"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("nothing named 'fliter' has run there; did you mean "
                                     "'filter'?"));
  EXPECT_THAT(Ask({"logs", "launcher"}).out, HasSubstr(", logs in "));
  Launched follower({LAUNCHER, "logs", "filter", "-f", "--run", folder_.Path("logs/latest")},
                    asking_);
  End();
  const Outcome followed = follower.Wait();
  EXPECT_EQ(followed.code, 0);
  EXPECT_EQ(followed.out, "filter: stuck\n");
}

}  // namespace
}  // namespace declutter
