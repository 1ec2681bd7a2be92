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

// Ours and the stock player of LCM, to a graph of which the source does not run.
class PlayerTest : public LogToolTest {
 protected:
  void PlayUntilTheLastFrameIsAnswered(const std::vector<std::string>& player) {
    const Outcome doctor = RunLauncher({"doctor"}, asking_);
    if (doctor.out.find("ok  multicast") == std::string::npos) GTEST_SKIP() << doctor.out;
    const std::string again = folder_.Path("again.lcm");
    Launched launcher({LAUNCHER, "run", LiveGraph(folder_, "", ""), "--only", "filter", "--url",
                       url_, "--record", again, "--log_dir", folder_.Path("logs")},
                      folder_);
    ASSERT_TRUE(Eventually([&] { return !UtimesOf("MODULE_STATUS", again).empty(); }));
    // A live graph takes the newest frame and may miss any one, the last of a playing too.
    EXPECT_TRUE(Eventually([&] {
      const Outcome played = Launched(player, asking_).Wait();
      EXPECT_EQ(played.code, 0) << played.err;
      const auto utimes = UtimesOf("OBJECTS", again);
      return std::find(utimes.begin(), utimes.end(), 50) != utimes.end();
    }));
    launcher.Signal(SIGTERM);
    EXPECT_EQ(launcher.Wait().code, 0) << ReadFile(folder_.Path("stderr"));
  }

  std::string url_ = "udpm://239.255.76.67:" + std::to_string(32'100 + getpid() % 600) + "?ttl=0";
};

TEST_F(PlayerTest, PlaysToAGraphThatListens) {
  PlayUntilTheLastFrameIsAnswered(
      {Program(), "play", log_, "--channels", "DEPTH_FRAME", "--speed", "2", "--url", url_});
}

TEST_F(PlayerTest, MakesLogsThatTheStockPlayerPlays) {
  PlayUntilTheLastFrameIsAnswered(
      {"/usr/bin/lcm-logplayer", "--lcm-url=" + url_, "--speed=2", "--regexp=DEPTH_FRAME", log_});
}

TEST_F(LogToolTest, FindsEveryMessageInTheLogThatWasPublished) {
  const Outcome outcome = Tool({"frames", log_});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("\n100 messages published by modules, 100 in the log\n"));
}

TEST_F(LogToolTest, NamesAnEmptyLogWhateverItIsAskedFor) {
  const std::string empty = folder_.Write("empty.lcm", "");
  const std::vector<std::vector<std::string>> questions = {
      {"info", empty},
      {"frames", empty},
      {"play", empty},
      {"cut", empty, folder_.Path("part")},
      {"top", empty},
      {"to_pictures", empty, folder_.Path("files")},
      {"to_pcd", empty, folder_.Path("files")}};
  for (const auto& question : questions) {
    const Outcome outcome = Tool(question);
    EXPECT_EQ(outcome.code, 1) << question[0];
    EXPECT_THAT(outcome.err, HasSubstr("empty.lcm: holds no events (0 byte)")) << question[0];
  }
  EXPECT_FALSE(fs::exists(folder_.Path("part")));
  for (const Outcome& outcome :
       {RunLauncher({"run", graph_, "--replay", empty}, folder_),
        Launched({Fake("fake_filter"), "--replay", empty}, folder_).Wait()}) {
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("empty.lcm: holds no events (0 byte)"));
  }
}

TEST_F(LogToolTest, NamesTheStageThatALogDoesNotHold) {
  const std::string part = folder_.Path("part.lcm");
  ASSERT_EQ(Tool({"cut", log_, part, "--channels", "OBJECTS"}).code, 0);
  const Outcome graph = RunLauncher({"run", graph_, "--replay", part}, folder_);
  EXPECT_EQ(graph.code, 1);
  EXPECT_THAT(graph.err, HasSubstr("part.lcm: no message on DEPTH_FRAME"));
  const Outcome module = Launched({Fake("fake_filter"), "--replay", part}, folder_).Wait();
  EXPECT_EQ(module.code, 1);
  EXPECT_THAT(module.err, HasSubstr("there is nothing on DEPTH_FRAME"));
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
