#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include "tests/process/fake_run.h"

namespace declutter {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kRestart = "restart: \"on_failure\" restart_delay_s: 0.05 ";

class RestartTest : public FakeRun {
 protected:
  // The process of a module; 0 while there is none.
  pid_t Find(const std::string& program) const {
    const auto found = ModulesOf(program);
    return found.size() == 1 ? found[0] : 0;
  }

  std::string Err() const { return ReadFile(folder_.Path("stderr")); }

  bool Says(const std::string& text) const {
    return Eventually([&] { return Err().find(text) != std::string::npos; });
  }
};

TEST_F(RestartTest, BringsAKilledModuleBackEachTime) {
  Launched launcher(Command(LiveGraph(folder_, kRestart, kRestart)), folder_);
  for (const char* program : {"fake_filter", "fake_source"}) {
    for (int i = 0; i < 3; ++i) {
      pid_t killed = 0;
      ASSERT_TRUE(Eventually([&] { return (killed = Find(program)) > 0; })) << Err();
      kill(killed, SIGKILL);
      ASSERT_TRUE(IsReplaced([&] { return Find(program); }, killed)) << Err();
    }
  }
  launcher.Signal(SIGTERM);
  EXPECT_EQ(launcher.Wait().code, 0) << Err();
}

TEST_F(RestartTest, ResultsComeAgainAfterACrash) {
  const std::string crash = FilterConfig("mishap: \"crashes\" at_frame: 20");
  const std::string log = folder_.Path("run.lcm");
  const Outcome outcome = RunLauncher({"run", LiveGraph(folder_, "", kRestart + crash), "--set",
                                       "source.num_frames=150", "--record", log},
                                      folder_);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("filter ended with signal 11 (Segmentation fault); "
                                     "starts again in 0.05 s"));
  const auto utimes = UtimesOf("OBJECTS", log);
  ASSERT_FALSE(utimes.empty());
  EXPECT_EQ(utimes.back(), 150);
}

TEST_F(RestartTest, GivesUpAModuleThatEndsAtOnceInALoop) {
  const std::string filter = FilterConfig("mishap: \"crashes_at_start\"");
  Launched launcher(Command(LiveGraph(folder_, "", kRestart + filter + " max_restarts: 3")),
                    folder_);
  const Outcome outcome = launcher.Wait();
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("starts again in 0.05 s"), HasSubstr("starts again in 0.1 s"),
                    HasSubstr("starts again in 0.2 s"), HasSubstr("after 3 restarts in a row")));
}

TEST_F(RestartTest, NeverRestartsAfterExitCodeTwo) {
  const std::string filter = FilterConfig("mishap: \"refuses\"");
  Launched launcher(Command(LiveGraph(folder_, "", "restart: \"always\" " + filter)), folder_);
  const Outcome outcome = launcher.Wait();
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, Not(HasSubstr("starts again")));
}

TEST_F(RestartTest, GoesOnWithoutAModuleThatIsNotRequired) {
  const std::string filter = FilterConfig("mishap: \"crashes\"");
  Launched launcher(Command(LiveGraph(folder_, "", "required: false " + filter)), folder_);
  ASSERT_TRUE(Says("the graph goes on without it"));
  EXPECT_GT(Find("fake_source"), 0);
  launcher.Signal(SIGTERM);
  EXPECT_EQ(launcher.Wait().code, 0);
}

TEST_F(RestartTest, RestartsAModuleThatHangsThoughItStillGivesSignsOfLife) {
  const std::string filter = FilterConfig("mishap: \"gets_stuck\" at_frame: 3");
  Launched launcher(Command(LiveGraph(folder_, "", kRestart + filter + " hang_limit_s: 1")),
                    folder_);
  ASSERT_TRUE(Says("filter hangs: input waits and no frame was finished for 1 s")) << Err();
  ASSERT_TRUE(Says("filter was killed; starts again in 0.05 s"));
  ASSERT_TRUE(Eventually([this] { return Find("fake_filter") > 0; }));
  launcher.Signal(SIGTERM);
  EXPECT_EQ(launcher.Wait().code, 0) << Err();
}

TEST_F(RestartTest, RestartsASourceThatHangsInItsSensor) {
  const std::string source = SourceConfig("num_frames: 1000 stuck_at: 5");
  const std::string graph = FakeGraph(folder_, kRestart + source + " hang_limit_s: 1", "");
  Launched launcher(Command(graph), folder_);
  ASSERT_TRUE(Says("source hangs: input waits and no frame was finished for 1 s")) << Err();
  ASSERT_TRUE(Says("source was killed; starts again in 0.05 s"));
  launcher.Signal(SIGTERM);
  EXPECT_EQ(launcher.Wait().code, 143) << Err();
}

TEST_F(RestartTest, FailsWhenAModuleHangsThatMayNotRestart) {
  const std::string filter = "hang_limit_s: 1 grace_period_s: 0.2 ";
  const Outcome outcome = RunLauncher(
      {"run", FakeGraph(folder_, "", filter + FilterConfig("mishap: \"gets_stuck\""))}, folder_);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("launcher: filter hangs: input waits"));
}

}  // namespace
}  // namespace declutter
