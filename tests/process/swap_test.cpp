#include <gmock/gmock.h>

#include <filesystem>

#include "tests/process/control_run.h"

namespace declutter {
namespace {

using testing::HasSubstr;
using testing::Not;

using SwapTest = ControlRun;

TEST_F(SwapTest, SwapsAModuleWithoutLosingOrDoublingAFrame) {
  Run("", "");
  ASSERT_TRUE(HasObjects(20));
  const auto before = ModulesOf("fake_filter");
  for (int i = 0; i < 2; ++i) {
    const Outcome outcome = Ask({"swap", "filter", Fake("fake_filter"), "--set",
                                 "filter.at_frame=" + std::to_string(50 + i)});
    ASSERT_EQ(outcome.code, 0) << outcome.err << ReadFile(folder_.Path("stderr"));
  }
  EXPECT_NE(ModulesOf("fake_filter"), before);
  EXPECT_THAT(ReadFile(folder_.Path("logs/latest/graph.textproto")), HasSubstr("at_frame: 51"));
  ASSERT_TRUE(HasObjects(UtimesOf("OBJECTS", log_).size() + 20));
  End();
  EXPECT_LE(NumLostOrDoubled(), 1);
}

TEST_F(SwapTest, KeepsTheOldModuleWhenTheNewOneNeverGetsReady) {
  Run("", "start_limit_s: 1");
  ASSERT_TRUE(HasObjects(20));
  const auto before = ModulesOf("fake_filter");
  const Outcome outcome =
      Ask({"swap", "filter", Fake("fake_filter"), "--set", "filter.mishap=hangs_at_start"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("filter was not swapped"));
  EXPECT_EQ(ModulesOf("fake_filter"), before);
  ASSERT_TRUE(HasObjects(UtimesOf("OBJECTS", log_).size() + 20));
  EXPECT_THAT(End().err, HasSubstr("the successor of filter is not ready 1 s after its start"));
  EXPECT_EQ(NumLostOrDoubled(), 0);
}

TEST_F(SwapTest, StartsTheOldModuleAgainWhenTheNewOneFailsAtItsFirstFrame) {
  Run("", "");
  ASSERT_TRUE(HasObjects(20));
  for (const char* mishap : {"crashes_at_start", "refuses"}) {
    const Outcome outcome =
        Ask({"swap", "filter", Fake("fake_filter"), "--set", std::string("filter.mishap=") + mishap,
             "--set", "filter.at_frame=0", "--set", "filter.num_frames=100000"});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("filter was not swapped"));
    ASSERT_TRUE(HasObjects(UtimesOf("OBJECTS", log_).size() + 20));
  }
  EXPECT_THAT(ReadFile(folder_.Path("logs/latest/graph.textproto")), Not(HasSubstr("mishap")));
  EXPECT_THAT(End().err, HasSubstr("before its first frame; filter starts again as it was"));
}

TEST_F(SwapTest, RefusesToSwapInWhatDoesNotFit) {
  Run("", "");
  const Outcome wrong_value =
      Ask({"swap", "filter", Fake("fake_filter"), "--set", "filter.mishap=rain"});
  EXPECT_EQ(wrong_value.code, 2);
  EXPECT_THAT(wrong_value.err, HasSubstr("is not one of"));
  const Outcome wrong_channels = Ask({"swap", "filter", Fake("fake_source")});
  EXPECT_EQ(wrong_channels.code, 2);
  EXPECT_THAT(wrong_channels.err, HasSubstr("filter publishes DEPTH_FRAME, as source does"));
  EXPECT_EQ(Ask({"swap", "filter", "/no/program"}).code, 2);
  End();
}

TEST_F(SwapTest, SwapsAModuleOfAPartOfAGraph) {
  Launched part({LAUNCHER, "run", FakeGraph(folder_, "after: \"filter\"", ""), "--without",
                 "filter", "--log_dir", folder_.Path("logs")},
                folder_);
  ASSERT_TRUE(Eventually([this] { return Row("source").find(" running ") != std::string::npos; }));
  const std::string resolved = folder_.Path("logs/latest/graph.textproto");
  EXPECT_THAT(ReadFile(resolved), HasSubstr("external: \"OBJECTS\""));
  EXPECT_EQ(Ask({"swap", "source", Fake("fake_source")}).code, 0);
  EXPECT_EQ(Launched({LAUNCHER, "check", resolved}, asking_).Wait().code, 0);
  part.Signal(SIGKILL);
  part.Wait();
}

TEST_F(SwapTest, SwapsInAProgramWithParametersOfItsOwn) {
  Run("", FilterConfig("at_frame: 50"));
  ASSERT_TRUE(HasObjects(20));
  const std::string other =
      folder_.Write("other_filter", "#!/bin/sh\n[ \"$1\" = --describe ] || exec " +
                                        Fake("fake_filter") + " \"$@\"\n" + Fake("fake_filter") +
                                        " --describe | sed s/FakeFilterConfig/OtherConfig/g\n");
  std::filesystem::permissions(other, std::filesystem::perms::owner_all);
  const Outcome outcome = Ask({"swap", "filter", other, "--set", "filter.at_frame=51"});
  ASSERT_EQ(outcome.code, 0) << outcome.err << ReadFile(folder_.Path("stderr"));
  EXPECT_THAT(ReadFile(folder_.Path("logs/latest/graph.textproto")), HasSubstr("OtherConfig"));
  EXPECT_THAT(ReadFile(folder_.Path("logs/latest/versions.txt")), HasSubstr(other + " 0."));
  // The log tells what made it before and what after.
  ASSERT_TRUE(Eventually([this] {
    const auto infos = MessagesOf("RUN_INFO", log_);
    return infos.size() >= 2 && infos.back().find("OtherConfig") != std::string::npos &&
           infos.front().find("OtherConfig") == std::string::npos;
  }));
  End();
}

}  // namespace
}  // namespace declutter
