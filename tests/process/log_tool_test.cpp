#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "tests/process/fake_graph.h"
#include "tests/process/launched.h"

namespace declutter {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

// A log of 50 frames of the fake graph, and what a user does with it.
class LogToolTest : public testing::Test {
 protected:
  LogToolTest() {
    const Outcome outcome = RunLauncher({"run", graph_, "--record", log_}, folder_);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  }

  static std::string Program() { return fs::path(LAUNCHER).parent_path() / "log_tool"; }

  Outcome Tool(std::vector<std::string> words) const {
    words.insert(words.begin(), Program());
    return Launched(words, asking_).Wait();
  }

  TemporaryFolder folder_;
  TemporaryFolder asking_;
  std::string graph_ = FakeGraph(folder_, SourceConfig("num_frames: 50"), "");
  std::string log_ = folder_.Path("run.lcm");
};

TEST_F(LogToolTest, TellsWhatALogHoldsAndWhatMadeIt) {
  const Outcome outcome = Tool({"info", log_});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(ContainsRegex("DEPTH_FRAME +depth_frame_t +50 "),
                                 ContainsRegex("OBJECTS +object_list_t +50 "),
                                 ContainsRegex("fake_filter 0\\.")));
}

TEST_F(LogToolTest, GivesTheGraphOfALogBack) {
  const Outcome outcome = Tool({"info", log_, "--graph"});
  EXPECT_THAT(outcome.out, HasSubstr("num_frames: 50"));
  EXPECT_EQ(RunLauncher({"check", folder_.Write("again", outcome.out)}, folder_).out, outcome.out);
}

TEST_F(LogToolTest, CutsOutChannelsOfWhichAReplayIsMade) {
  const std::string part = folder_.Path("part.lcm");
  EXPECT_EQ(Tool({"cut", log_, part, "--channels", "DEPTH_FRAME"}).code, 0);
  EXPECT_THAT(UtimesOf("DEPTH_FRAME", part), SizeIs(50));
  EXPECT_THAT(UtimesOf("OBJECTS", part), IsEmpty());
  EXPECT_THAT(UtimesOf("RUN_INFO", part), Not(IsEmpty()));
  const std::string again = folder_.Path("again.lcm");
  EXPECT_EQ(RunLauncher({"run", graph_, "--replay", part, "--record", again}, folder_).code, 0);
  EXPECT_THAT(UtimesOf("OBJECTS", again), SizeIs(50));
}

TEST_F(LogToolTest, SaysWhatIsDamagedAndCopiesTheRest) {
  fs::resize_file(log_, fs::file_size(log_) - 5);
  const Outcome info = Tool({"info", log_});
  EXPECT_EQ(info.code, 1);
  EXPECT_THAT(info.out, ContainsRegex("run.lcm: cut off after [0-9]+ events"));
  const std::string part = folder_.Path("part.lcm");
  EXPECT_EQ(Tool({"cut", log_, part}).code, 1);
  EXPECT_EQ(Tool({"info", part}).code, 0);
  EXPECT_THAT(UtimesOf("DEPTH_FRAME", part), SizeIs(50));
}

TEST_F(LogToolTest, PlaysToAGraphThatListens) {
  const Outcome doctor = RunLauncher({"doctor"}, asking_);
  if (doctor.out.find("ok  multicast") == std::string::npos) GTEST_SKIP() << doctor.out;
  const std::string url =
      "udpm://239.255.76.67:" + std::to_string(32'100 + getpid() % 600) + "?ttl=0";
  const std::string again = folder_.Path("again.lcm");
  Launched launcher({LAUNCHER, "run", LiveGraph(folder_, "", ""), "--only", "filter", "--url", url,
                     "--record", again, "--log_dir", folder_.Path("logs")},
                    folder_);
  ASSERT_TRUE(Eventually([&] { return !UtimesOf("MODULE_STATUS", again).empty(); }));
  // A live graph takes the newest frame and may miss any one, the last of a playing too.
  EXPECT_TRUE(Eventually([&] {
    const Outcome played =
        Tool({"play", log_, "--channels", "DEPTH_FRAME", "--speed", "2", "--url", url});
    EXPECT_EQ(played.code, 0) << played.err;
    const auto utimes = UtimesOf("OBJECTS", again);
    return std::find(utimes.begin(), utimes.end(), 50) != utimes.end();
  }));
  launcher.Signal(SIGTERM);
  EXPECT_EQ(launcher.Wait().code, 0) << ReadFile(folder_.Path("stderr"));
}

TEST_F(LogToolTest, RefusesWhatItCannotDo) {
  EXPECT_EQ(Tool({}).code, 2);
  EXPECT_EQ(Tool({"inof", log_}).code, 2);
  EXPECT_EQ(Tool({"info"}).code, 2);
  EXPECT_EQ(Tool({"cut", log_, log_}).code, 2);
  EXPECT_EQ(Tool({"play", log_, "--speed", "fast"}).code, 2);
  EXPECT_EQ(Tool({"info", log_ + ".none"}).code, 1);
  EXPECT_EQ(Tool({"cut", log_, folder_.Path("none"), "--start", "1000"}).code, 1);
}

}  // namespace
}  // namespace declutter
