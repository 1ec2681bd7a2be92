#include <gmock/gmock.h>
#include <sched.h>
#include <signal.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/process/fake_run.h"

namespace declutter {
namespace {

using testing::HasSubstr;

using NetworkTest = FakeRun;

TEST_F(NetworkTest, MakesItsOwnNetworkWhereThereIsNoMulticast) {
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

TEST_F(NetworkTest, RunsInANetworkOfItsOwnWhenAsked) {
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

TEST_F(NetworkTest, RefusesASecondGraphOnTheSameUrlAndNamesTheFirst) {
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

TEST_F(NetworkTest, KeepsTwoRunsAtATimeApart) {
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
