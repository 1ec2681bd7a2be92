#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <sys/mount.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/process/fake_run.h"

namespace declutter {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

// A camera of 50 Hz, a filter and a logger in the graph.
class LoggerTest : public FakeRun {
 protected:
  std::string Graph(const std::string& logger_fields) {
    const std::string graph = LiveGraph(folder_, "", "");
    return folder_.Write("logged.textproto",
                         "include: \"graph.textproto\"\nlogger { " + logger_fields + " }");
  }

  std::string File(int number) const {
    return folder_.Path("logs/latest/run.lcmlog.0" + std::to_string(number));
  }

  // To be called in a child: its logs are on a disk of their own, of that size.
  std::function<void()> WithDiskOf(const std::string& size) const {
    fs::create_directory(folder_.Path("logs"));
    return [=, uid = getuid(), gid = getgid()] {
      if (unshare(CLONE_NEWNS) != 0) {
        if (unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) _exit(99);
        std::ofstream("/proc/self/setgroups") << "deny";
        std::ofstream("/proc/self/uid_map") << uid << " " << uid << " 1";
        std::ofstream("/proc/self/gid_map") << gid << " " << gid << " 1";
      }
      mount("", "/", "", MS_REC | MS_PRIVATE, "");
      const std::string options = "size=" + size;
      if (mount("tmpfs", folder_.Path("logs").c_str(), "tmpfs", 0, options.c_str()) != 0) _exit(99);
    };
  }

  static bool HasFrames(const std::string& file, size_t num) {
    return Eventually([&] { return UtimesOf("OBJECTS", file).size() >= num; });
  }
};

TEST_F(LoggerTest, RecordsTheRunWithWhatMadeItToTheLastMessage) {
  Launched launcher(Command(Graph("")), folder_);
  ASSERT_TRUE(HasFrames(File(0), 20));
  launcher.Signal(SIGTERM);
  const Outcome outcome = launcher.Wait();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const auto frames = UtimesOf("DEPTH_FRAME", File(0));
  EXPECT_EQ(frames.front(), 1);
  EXPECT_EQ(frames.back(), static_cast<int64_t>(frames.size()));
  EXPECT_FALSE(UtimesOf("RUN_INFO", File(0)).empty());
  EXPECT_THAT(ReadFile(File(0)),
              AllOf(HasSubstr("fake_filter 0."), HasSubstr("num_frames: 100000")));
}

TEST_F(LoggerTest, BeginsTheNextFileWhenOneIsFullAndSaysThereTooWhatMadeIt) {
  std::vector<std::string> command = Command(Graph("split_mb: 4"));
  command.insert(command.end(), {"--set", "source.num_bytes=50000"});
  Launched launcher(command, folder_);
  for (const int number : {1, 2}) {
    ASSERT_TRUE(Eventually([&] { return !UtimesOf("RUN_INFO", File(number)).empty(); }));
  }
  launcher.Signal(SIGTERM);
  EXPECT_EQ(launcher.Wait().code, 0);
  EXPECT_LT(fs::file_size(File(0)), 4'500'000u);
  // From file to file no frame is missing.
  EXPECT_EQ(UtimesOf("DEPTH_FRAME", File(1)).front(), UtimesOf("DEPTH_FRAME", File(0)).back() + 1);
  // Joined, they are one log.
  const std::string joined = folder_.Write("joined.lcm", ReadFile(File(0)) + ReadFile(File(1)));
  const std::string log_tool = fs::path(LAUNCHER).parent_path() / "log_tool";
  const Outcome info = Launched({log_tool, "info", joined}, folder_).Wait();
  EXPECT_EQ(info.code, 0) << info.out << info.err;
  EXPECT_EQ(UtimesOf("DEPTH_FRAME", joined).size(),
            UtimesOf("DEPTH_FRAME", File(0)).size() + UtimesOf("DEPTH_FRAME", File(1)).size());
}

TEST_F(LoggerTest, IsBackInANewFileEachTimeItIsKilled) {
  Launched launcher(Command(Graph("")), folder_);
  for (int number = 0; number < 3; ++number) {
    ASSERT_TRUE(HasFrames(File(number), 10)) << ReadFile(folder_.Path("stderr"));
    const auto loggers = ProcessesWith(folder_.Path("logs") + "/");
    for (const pid_t pid : loggers) {
      if (ReadFile("/proc/" + std::to_string(pid) + "/comm") == "lcm-logger\n") kill(pid, SIGKILL);
    }
  }
  ASSERT_TRUE(HasFrames(File(3), 10));
  launcher.Signal(SIGTERM);
  EXPECT_EQ(launcher.Wait().code, 0);
}

TEST_F(LoggerTest, SaysBeforeTheRunThatTheDiskIsFull) {
  const Outcome outcome = Launched(Command(Graph("min_free_mb: 1e9")), folder_).Wait();
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("left, to record needs 1000000000 MB"));
  EXPECT_THAT(UtimesOf("DEPTH_FRAME", File(0)), IsEmpty());
}

TEST_F(LoggerTest, EndsTheLogWholeWhenTheDiskFillsAndTheGraphGoesOn) {
  Launched launcher(Command(Graph("min_free_mb: 4")), folder_, WithDiskOf("12m"));
  const std::string root = "/proc/" + std::to_string(launcher.pid()) + "/root";
  const std::string file = root + File(0);
  if (!HasFrames(file, 10)) {
    if (launcher.Wait().code == 99) GTEST_SKIP() << "no mounts here";
    FAIL();
  }
  std::ofstream(root + folder_.Path("logs/filler")) << std::string(9 << 20, '-') << std::flush;
  ASSERT_TRUE(Eventually([this] {
    return ReadFile(folder_.Path("stderr")).find("a disk that has less than 4 MB left") !=
           std::string::npos;
  })) << ReadFile(folder_.Path("stderr"));
  const auto recorded = UtimesOf("OBJECTS", file);
  EXPECT_GE(recorded.size(), 10u);
  EXPECT_EQ(ModulesOf("fake_filter").size(), 1u);
  launcher.Signal(SIGTERM);
  const Outcome outcome = launcher.Wait();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("the graph goes on without it"));
}

TEST_F(LoggerTest, SaysThatWhatAModulePrintsIsLostWhenTheDiskIsFullAndGoesOn) {
  const std::string graph =
      FakeGraph(folder_, SourceConfig("num_frames: 1"), FilterConfig("mishap: \"fills_stdout\""));
  const Outcome outcome = Launched(Command(graph), folder_, WithDiskOf("2m")).Wait();
  if (outcome.code == 99) GTEST_SKIP() << "no mounts here";
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("/filter.log: No space left on device; what its process "
                                     "prints is lost"));
}

}  // namespace
}  // namespace declutter
