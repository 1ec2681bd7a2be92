#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <filesystem>

#include "tests/process/fake_run.h"

namespace declutter {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

using RunTest = FakeRun;

TEST_F(RunTest, EndsWithZeroWhenTheSourceIsFinished) {
  const Outcome outcome = RunLauncher({"run", FakeGraph(folder_, "", "")}, folder_);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, IsEmpty());
}

TEST_F(RunTest, EndsWithTheCodeOfTheSource) {
  const std::string graph = FakeGraph(folder_, SourceConfig("fails: true"), "");
  const Outcome outcome = RunLauncher({"run", graph}, folder_);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("source: an input is unreadable"));
}

TEST_F(RunTest, WritesTheResolvedGraphAndALogOfEachProcess) {
  const std::string graph = FakeGraph(folder_, SourceConfig("fails: true"), "");
  RunLauncher({"run", graph, "--set", "source.num_frames=2"}, folder_);
  const std::string latest = folder_.Path("logs/latest/");
  EXPECT_THAT(ReadFile(latest + "graph.textproto"), HasSubstr("num_frames: 2"));
  EXPECT_THAT(ReadFile(latest + "source.textproto"), HasSubstr("num_frames: 2"));
  EXPECT_THAT(ReadFile(latest + "source.log"), HasSubstr("an input is unreadable"));
  EXPECT_THAT(ReadFile(latest + "versions.txt"), HasSubstr(Fake("fake_filter") + " 0."));
  EXPECT_THAT(ReadFile(latest + "launcher.log"), HasSubstr(", logs in " + folder_.Path("logs/")));
}

TEST_F(RunTest, EndsWithOneWhenAModuleCrashes) {
  const std::string graph =
      FakeGraph(folder_, SourceConfig(kEndless), FilterConfig("mishap: \"crashes\""));
  const Outcome outcome = RunLauncher({"run", graph}, folder_);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("launcher: filter ended with signal 11"));
}

TEST_F(RunTest, EndsWithTwoWhenAModuleRefusesItsParameters) {
  const std::string graph =
      FakeGraph(folder_, SourceConfig(kEndless), FilterConfig("mishap: \"refuses\""));
  const Outcome outcome = RunLauncher({"run", graph}, folder_);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("not with these parameters"));
}

TEST_F(RunTest, StartsNothingOfAGraphWithAFault) {
  const std::string graph = FakeGraph(folder_, "", FilterConfig("mishap: \"rain\""));
  EXPECT_EQ(RunLauncher({"run", graph}, folder_).code, 2);
  EXPECT_THAT(ReadFile(folder_.Path("logs/latest/graph.textproto")), IsEmpty());
}

TEST_F(RunTest, FailsWhenAModuleGivesNoSignOfLife) {
  const std::string graph =
      FakeGraph(folder_, "", "start_limit_s: 0.5 " + FilterConfig("mishap: \"hangs_at_start\""));
  const Outcome outcome = RunLauncher({"run", graph}, folder_);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("filter is not ready 0.5 s after its start"));
}

TEST_F(RunTest, KillsAModuleThatDoesNotStopAndSaysSo) {
  const std::string graph =
      FakeGraph(folder_, SourceConfig("num_frames: 1"),
                "grace_period_s: 0.5 " + FilterConfig("mishap: \"gets_stuck\""));
  Launched launcher(Command(graph), folder_);
  ASSERT_TRUE(Eventually([this] {
    return ReadFile(folder_.Path("stderr")).find("filter: stuck") != std::string::npos;
  }));
  launcher.Signal(SIGTERM);
  const Outcome outcome = launcher.Wait();
  EXPECT_EQ(outcome.code, 143);
  EXPECT_THAT(outcome.err, HasSubstr("filter still runs 0.5 s after it was asked to stop: killed"));
}

TEST_F(RunTest, KeepsNoMoreThanTwoFilesOfAModuleThatFillsItsStdout) {
  const std::string graph = FakeGraph(folder_, "", FilterConfig("mishap: \"fills_stdout\""));
  EXPECT_EQ(RunLauncher({"run", graph}, folder_).code, 0);
  const std::string log = folder_.Path("logs/latest/filter.log");
  EXPECT_GT(std::filesystem::file_size(log + ".1"), 9u << 20);
  EXPECT_LE(std::filesystem::file_size(log + ".1"), 10u << 20);
  EXPECT_LE(std::filesystem::file_size(log), 10u << 20);
}

TEST_F(RunTest, IsNotHeldByAConsoleThatTakesNoMore) {
  const std::string noisy =
      folder_.Write("noisy", "#!/bin/sh\n[ \"$1\" = --describe ] || yes " + folder_.Path("") +
                                 " >&2 &\nexec " + Fake("fake_filter") + " \"$@\"\n");
  std::filesystem::permissions(noisy, std::filesystem::perms::owner_all);
  const std::string graph = folder_.Write(
      "graph.textproto", Block("source", "fake_source", SourceConfig("num_frames: 50")) +
                             "module { name: \"filter\" program: \"" + noisy + "\" }");
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  Launched launcher(Command(graph), folder_, [&] { dup2(ends[1], STDERR_FILENO); });
  EXPECT_EQ(launcher.Wait().code, 0);
  EXPECT_GT(std::filesystem::file_size(folder_.Path("logs/latest/filter.log")), 100'000u);
  for (const int end : ends) close(end);
}

TEST_F(RunTest, StopsInOrderOnASignal) {
  const std::string graph = FakeGraph(folder_, SourceConfig(kEndless), "");
  Launched launcher(Command(graph), folder_);
  ASSERT_TRUE(Eventually([this] { return Processes().size() == kNumProcesses; }));
  launcher.Signal(SIGINT);
  const Outcome outcome = launcher.Wait();
  EXPECT_EQ(outcome.code, 130);
  EXPECT_THAT(outcome.err, HasSubstr("launcher: stopping on signal 2"));
}

TEST_F(RunTest, LeavesNoProcessBehindWhenTheLauncherIsKilled) {
  const std::string graph = FakeGraph(folder_, SourceConfig(kEndless), "");
  for (int i = 0; i < 3; ++i) {
    Launched launcher(Command(graph), folder_);
    ASSERT_TRUE(Eventually([this] { return Processes().size() == kNumProcesses; }));
    launcher.Signal(SIGKILL);
    EXPECT_EQ(launcher.Wait().code, 128 + SIGKILL);
    EXPECT_TRUE(Eventually([this] { return Processes().empty(); }));
  }
}

TEST_F(RunTest, LeavesNothingBehindThatAModuleHasStarted) {
  const std::string program = folder_.Write(
      "with_helper", "#!/bin/sh\ntail -f " + folder_.Path("graph.textproto") + " >" +
                         folder_.Path("tail") + " &\nexec " + Fake("fake_filter") + " \"$@\"\n");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  const std::string graph = folder_.Write(
      "graph.textproto", Block("source", "fake_source", SourceConfig(kEndless)) +
                             "module { name: \"filter\" program: \"" + program + "\" }");
  for (const int signal : {SIGKILL, SIGTERM}) {
    Launched launcher(Command(graph), folder_);
    ASSERT_TRUE(Eventually([this] { return Processes().size() == kNumProcesses + 1; }));
    launcher.Signal(signal);
    launcher.Wait();
    EXPECT_TRUE(Eventually([this] { return Processes().empty(); }));
  }
}

TEST_F(RunTest, StopsInOrderWhenItsTerminalCloses) {
  const std::string log = folder_.Path("run.lcm");
  std::vector<std::string> command = Command(LiveGraph(folder_, "", ""));
  command.insert(command.end(), {"--record", log});
  Launched launcher(command, folder_);
  ASSERT_TRUE(Eventually([&] { return UtimesOf("OBJECTS", log).size() > 20; }));
  launcher.Signal(SIGHUP);
  const Outcome outcome = launcher.Wait();
  EXPECT_EQ(outcome.code, 0) << outcome.err;  // the log is complete
  EXPECT_GT(UtimesOf("OBJECTS", log).size(), 20u);
  EXPECT_THAT(outcome.err, HasSubstr("launcher: stopping on signal 1"));
}

}  // namespace
}  // namespace declutter
