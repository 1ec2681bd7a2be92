#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "modules/runtime/event_log.h"
#include "tests/process/fake_graph.h"
#include "tests/process/launched.h"
#include "tests/process/terminal.h"

namespace declutter {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Each;
using testing::Ge;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Le;
using testing::SizeIs;

// A second of a camera of 50 Hz, and what a user plays of it.
class ReplayOptionsTest : public testing::Test {
 protected:
  ReplayOptionsTest() {
    const Outcome outcome = RunLauncher({"run", graph_, "--record", log_}, folder_);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  }

  std::vector<std::string> Command(const std::vector<std::string>& options) const {
    std::vector<std::string> words = {LAUNCHER,   "run",  graph_,      "--replay",          log_,
                                      "--record", again_, "--log_dir", folder_.Path("logs")};
    words.insert(words.end(), options.begin(), options.end());
    return words;
  }

  Outcome Replay(const std::vector<std::string>& options) const {
    return Launched(Command(options), folder_).Wait();
  }

  std::vector<int64_t> Answered() const { return UtimesOf("OBJECTS", again_); }

  // Copies the log with its messages changed.
  void Change(const std::function<void(runtime::LogEvent*)>& change) const {
    const std::string whole = folder_.Path("whole.lcm");
    fs::rename(log_, whole);
    runtime::EventLogReader reader(whole);
    runtime::EventLogWriter writer(log_);
    while (auto event = reader.Next()) {
      change(&*event);
      writer.Write(*event);
    }
  }

  TemporaryFolder folder_;
  std::string graph_ = FakeGraph(folder_, SourceConfig("num_frames: 50 period_s: 0.02"), "");
  std::string log_ = folder_.Path("run.lcm");
  std::string again_ = folder_.Path("again.lcm");
};

TEST_F(ReplayOptionsTest, PlaysAtASpeedAndMaySkipFrames) {
  const Outcome outcome = Replay({"--speed", "2"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(UtimesOf("DEPTH_FRAME", again_), SizeIs(50));
  EXPECT_THAT(Answered(), AllOf(SizeIs(Ge(1u)), SizeIs(Le(50u))));
}

TEST_F(ReplayOptionsTest, PlaysAPartWithoutLoss) {
  const Outcome outcome = Replay({"--start", "0.4", "--end", "0.7"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(Answered(), AllOf(SizeIs(Ge(5u)), SizeIs(Le(20u)), Each(AllOf(Ge(2), Le(49)))));
  const Outcome none = RunLauncher({"run", graph_, "--replay", log_, "--start", "99"}, folder_);
  EXPECT_EQ(none.code, 1);
  EXPECT_THAT(none.err, HasSubstr("run.lcm: no message in that part on DEPTH_FRAME"));
}

TEST_F(ReplayOptionsTest, PlaysAgainAndAgainUntilASignal) {
  const std::vector<std::vector<std::string>> ways = {{"--loop", "--speed", "5"},
                                                      {"--loop", "--end", "0.5"}};
  for (const auto& options : ways) {
    fs::remove(again_);
    Launched launcher(Command(options), folder_);
    ASSERT_TRUE(Eventually([this] {
      const auto sent = UtimesOf("DEPTH_FRAME", again_);
      return std::count(sent.begin(), sent.end(), 7) >= 3;
    }));
    launcher.Signal(SIGTERM);
    EXPECT_EQ(launcher.Wait().code, 0) << ReadFile(folder_.Path("stderr"));
  }
}

TEST_F(ReplayOptionsTest, StopsAndStepsWhenAKeyIsPressed) {
  const Terminal terminal;
  const tcflag_t before = terminal.Mode();
  Launched launcher(Command({"--speed", "0.2"}), folder_, terminal.AsStdin());
  ASSERT_TRUE(Eventually([this] { return Answered().size() >= 3; }));
  terminal.Press(' ');
  size_t num = 0;
  // Frames come every 0.1 s: when there is none for longer it stands still.
  ASSERT_TRUE(Eventually([&] {
    num = Answered().size();
    usleep(500'000);
    return Answered().size() == num;
  }));
  terminal.Press('n');
  EXPECT_TRUE(Eventually([&] { return Answered().size() == num + 1; }));
  terminal.Press(' ');
  EXPECT_TRUE(Eventually([&] { return Answered().size() > num + 3; }));
  launcher.Signal(SIGTERM);
  EXPECT_EQ(launcher.Wait().code, 0) << ReadFile(folder_.Path("stderr"));
  EXPECT_EQ(terminal.Mode(), before);
}

TEST_F(ReplayOptionsTest, NamesChannelAndTypeOfALogOfAnotherVersion) {
  Change([](runtime::LogEvent* event) {
    if (event->channel == "DEPTH_FRAME") event->message[3] ^= 0x40;
  });
  const std::string fault = "not a depth_frame_t of this version (fingerprint 0x";
  const Outcome graph = Replay({});
  EXPECT_EQ(graph.code, 1);
  EXPECT_THAT(graph.err, HasSubstr("run.lcm: on DEPTH_FRAME is " + fault));
  EXPECT_THAT(Answered(), IsEmpty());
  const Outcome module = Launched({Fake("fake_filter"), "--replay", log_}, folder_).Wait();
  EXPECT_EQ(module.code, 1);
  EXPECT_THAT(module.err, HasSubstr("fake_filter: DEPTH_FRAME: rejected: " + fault));
}

TEST_F(ReplayOptionsTest, EndsWithOneWhenAModuleAloneRejectsAMessage) {
  Change([num = 0](runtime::LogEvent* event) mutable {
    if (event->channel == "DEPTH_FRAME" && ++num == 7) event->message.pop_back();
  });
  const Outcome outcome =
      Launched({Fake("fake_filter"), "--replay", log_, "--record", again_}, folder_).Wait();
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("run.lcm: 1 messages or frames were rejected"));
  EXPECT_THAT(Answered(), SizeIs(49));
}

TEST_F(ReplayOptionsTest, ReplaysALogThatIsCutOffUpToThere) {
  fs::resize_file(log_, fs::file_size(log_) / 2);
  const size_t num_whole = UtimesOf("DEPTH_FRAME", log_).size();
  const Outcome outcome = Replay({});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("run.lcm: cut off after "));
  EXPECT_THAT(Answered(), SizeIs(num_whole));
}

TEST_F(ReplayOptionsTest, DoesNotWaitForAClockThatWentAstray) {
  Change([num = 0](runtime::LogEvent* event) mutable {
    ++num;
    if (num == 20) event->utime += int64_t{1} << 50;
    if (num > 40) event->utime -= 3'600'000'000;
  });
  const Outcome outcome = Replay({"--speed", "5"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(UtimesOf("DEPTH_FRAME", again_), SizeIs(50));
}

TEST_F(ReplayOptionsTest, SaysThatADiskIsFullAndNamesTheLog) {
  const auto fill_disk = [] {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit = {2000, 2000};
    setrlimit(RLIMIT_FSIZE, &limit);
  };
  const Outcome outcome =
      Launched({Fake("fake_filter"), "--replay", log_, "--record", again_}, folder_, fill_disk)
          .Wait();
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("again.lcm: cannot be written (File too large)"));
}

TEST_F(ReplayOptionsTest, RefusesOptionsWithoutALog) {
  for (const std::string option : {"--speed", "--start", "--end"}) {
    EXPECT_EQ(RunLauncher({"run", graph_, option, "2"}, folder_).code, 2) << option;
    EXPECT_EQ(RunLauncher({"run", graph_, "--replay", log_, option, "x"}, folder_).code, 2);
  }
  EXPECT_EQ(RunLauncher({"run", graph_, "--loop"}, folder_).code, 2);
}

}  // namespace
}  // namespace declutter
