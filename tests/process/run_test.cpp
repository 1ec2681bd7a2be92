#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/process/fake_graph.h"
#include "tests/process/launched.h"

namespace declutter {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class RunTest : public testing::Test {
 protected:
  // Each of our processes has the folder's path on its command line: the launcher, the guard that
  // outlives it for a moment, and two modules.
  static constexpr size_t kNumProcesses = 4;
  std::vector<pid_t> Processes() const { return ProcessesWith(folder_.Path("")); }

  std::vector<std::string> Command(const std::string& graph) const {
    return {LAUNCHER, "run", graph, "--log_dir", folder_.Path("logs")};
  }

  void TearDown() override {
    EXPECT_TRUE(Eventually([this] { return Processes().empty(); })) << "left behind";
  }

  TemporaryFolder folder_;
};

constexpr const char* kEndless = "num_frames: 100000";

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

TEST_F(RunTest, RecordsEveryMessage) {
  const std::string log = folder_.Path("run.lcm");
  const std::string graph = FakeGraph(folder_, SourceConfig("num_frames: 50"), "");
  const Outcome outcome = RunLauncher({"run", graph, "--record", log}, folder_);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(UtimesOf("DEPTH_FRAME", log).size(), 50u);
  EXPECT_EQ(UtimesOf("OBJECTS", log).size(), 50u);
}

TEST_F(RunTest, ReplaysALogWithoutItsSourceAndSkipsNoFrame) {
  const std::string log = folder_.Path("run.lcm");
  const std::string graph = FakeGraph(folder_, SourceConfig("num_frames: 50"), "");
  RunLauncher({"run", graph, "--record", log}, folder_);
  const std::string again = folder_.Path("again.lcm");
  const Outcome outcome = RunLauncher({"run", graph, "--replay", log, "--record", again}, folder_);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(UtimesOf("DEPTH_FRAME", again).size(), 50u);
  EXPECT_EQ(UtimesOf("OBJECTS", again).size(), 50u);
  EXPECT_THAT(ReadFile(folder_.Path("logs/latest/source.log")), IsEmpty());
}

TEST_F(RunTest, RefusesToReplayFromAModuleThatTheGraphDoesNotHave) {
  const std::string graph = FakeGraph(folder_, "", "");
  const Outcome outcome =
      RunLauncher({"run", graph, "--replay", "log", "--from", "fliter"}, folder_);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("no such module; did you mean 'filter'?"));
}

TEST_F(RunTest, FailsWhenTheLogToReplayCannotBeRead) {
  const std::string graph = FakeGraph(folder_, "", "");
  const Outcome outcome = RunLauncher({"run", graph, "--replay", folder_.Path("none")}, folder_);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr(folder_.Path("none")));
}

TEST_F(RunTest, RefusesToRecordOverAFile) {
  const std::string log = folder_.Write("run.lcm", "precious");
  const Outcome outcome =
      RunLauncher({"run", FakeGraph(folder_, "", ""), "--record", log}, folder_);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("exists already"));
  EXPECT_EQ(ReadFile(log), "precious");
}

TEST_F(RunTest, FailsWhenTheLogCannotBeWritten) {
  const std::string graph = FakeGraph(folder_, "", "");
  const std::string log = folder_.Write("no_folder", "") + "/run.lcm";
  const Outcome outcome = RunLauncher({"run", graph, "--record", log}, folder_);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("lcm-logger ended"));
}

TEST_F(RunTest, MakesItsOwnNetworkWhereThereIsNoMulticast) {
  const std::string graph = FakeGraph(folder_, "", "");
  const auto leave_network = [uid = getuid(), gid = getgid()] {
    if (unshare(CLONE_NEWNET) == 0) return;
    if (unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) _exit(99);
    // Only a user who has a number in this namespace may open the next one.
    std::ofstream("/proc/self/setgroups") << "deny";
    std::ofstream("/proc/self/uid_map") << uid << " " << uid << " 1";
    std::ofstream("/proc/self/gid_map") << gid << " " << gid << " 1";
  };
  Launched launcher(Command(graph), folder_, leave_network);
  const Outcome outcome = launcher.Wait();
  if (outcome.code == 99) GTEST_SKIP() << "no network namespaces here";
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST_F(RunTest, RunsInANetworkOfItsOwnWhenAsked) {
  std::vector<std::string> command = Command(FakeGraph(folder_, SourceConfig(kEndless), ""));
  command.push_back("--isolate");
  Launched launcher(command, folder_);
  const auto says = [this](const std::string& text) {
    return ReadFile(folder_.Path("stderr")).find(text) != std::string::npos;
  };
  ASSERT_TRUE(Eventually(
      [&] { return Processes().size() == kNumProcesses || says("no network namespace"); }));
  if (says("no network namespace")) GTEST_SKIP() << "no network namespaces here";
  EXPECT_TRUE(says(" in a network of its own, logs in "));
  const auto network = [](const std::string& pid) {
    return std::filesystem::read_symlink("/proc/" + pid + "/ns/net").string();
  };
  for (const pid_t process : Processes()) {
    const std::string pid = std::to_string(process);
    if (ReadFile("/proc/" + pid + "/comm") == "launcher-guard\n") continue;
    EXPECT_NE(network(pid), network("self"));
  }
  launcher.Signal(SIGINT);
  EXPECT_EQ(launcher.Wait().code, 130);
}

TEST_F(RunTest, RefusesASecondGraphOnTheSameUrlAndNamesTheFirst) {
  std::vector<std::string> command = Command(FakeGraph(folder_, SourceConfig(kEndless), ""));
  const std::string url = "udpm://239.255.76.67:" + std::to_string(32'100 + getpid() % 600);
  command.insert(command.end(), {"--url", url + "?ttl=0"});
  Launched first(command, folder_);
  ASSERT_TRUE(Eventually([this] { return Processes().size() == kNumProcesses; }));
  const TemporaryFolder other;
  const Outcome second =
      RunLauncher({"run", FakeGraph(other, "", ""), "--url", url + "?ttl=1"}, other);
  EXPECT_EQ(second.code, 2);
  EXPECT_THAT(second.err, HasSubstr("the launcher with process number " +
                                    std::to_string(first.pid()) + " runs a graph there"));
  first.Signal(SIGINT);
  EXPECT_EQ(first.Wait().code, 130);
}

TEST_F(RunTest, KeepsTwoRunsAtATimeApart) {
  const TemporaryFolder other;
  const std::string graph = FakeGraph(folder_, SourceConfig("num_frames: 50"), "");
  const std::string log = folder_.Path("run.lcm");
  std::vector<std::string> command = Command(graph);
  command.insert(command.end(), {"--record", log});
  Launched first(command, folder_);
  Launched second(Command(FakeGraph(other, SourceConfig("num_frames: 50"), "")), other);
  EXPECT_EQ(first.Wait().code, 0);
  EXPECT_EQ(second.Wait().code, 0);
  EXPECT_EQ(UtimesOf("DEPTH_FRAME", log).size(), 50u);
}

}  // namespace
}  // namespace declutter
