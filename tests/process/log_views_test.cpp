#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "modules/imaging/png_file.h"
#include "tests/process/graph_run.h"
#include "tests/process/terminal.h"

namespace declutter {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::SizeIs;

// A log of the whole graph, and what a user looks at in it.
class LogViewsTest : public GraphRun {
 protected:
  LogViewsTest() {
    RenderScene("a");
    RenderScene("b");
    const Outcome outcome = Run(scenes_, output_, {"--record", log_});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  }

  Outcome Tool(std::vector<std::string> words, const std::function<void()>& before = {}) {
    words.insert(words.begin(), Program("log_tool"));
    return Launched(words, folder_, before).Wait();
  }

  static std::vector<std::string> FilesIn(const std::string& path) {
    std::vector<std::string> files;
    for (const auto& entry : fs::directory_iterator(path)) files.push_back(entry.path().filename());
    std::sort(files.begin(), files.end());
    return files;
  }

  std::string log_ = folder_.Path("run.lcm");
};

TEST_F(LogViewsTest, DrawsTheOverlaysOfTheRunAndMore) {
  const std::string pictures = folder_.Path("pictures");
  const Outcome outcome = Tool({"to_pictures", log_, pictures});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(FilesIn(pictures),
              testing::ElementsAre("a.curvature.png", "a.overlay.png", "a.r_min.png", "a.top.png",
                                   "b.curvature.png", "b.overlay.png", "b.r_min.png", "b.top.png",
                                   "contact_sheet_1.png"));
  EXPECT_EQ(imaging::ReadRgbPng(pictures + "/a.overlay.png").rgb,
            imaging::ReadRgbPng(output_ + "/a.overlay.png").rgb);
  EXPECT_GT(imaging::ReadRgbPng(pictures + "/contact_sheet_1.png").width, 640);
}

TEST_F(LogViewsTest, DrawsWhatOneChannelShows) {
  const std::string pictures = folder_.Path("pictures");
  const Outcome outcome = Tool({"to_pictures", log_, pictures, "--channels", "DEPTH_FRAME"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(FilesIn(pictures),
              testing::ElementsAre("a.overlay.png", "b.overlay.png", "contact_sheet_1.png"));
}

TEST_F(LogViewsTest, WritesCloudsThatAGraphReads) {
  const std::string clouds = folder_.Path("clouds");
  const Outcome outcome = Tool({"to_pcd", log_, clouds});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(FilesIn(clouds),
              testing::ElementsAre("a.models.pcd", "a.pcd", "b.models.pcd", "b.pcd"));
  const std::string found = folder_.Path("found");
  ASSERT_EQ(Run(clouds + "/a.pcd", found).code, 0);
  ASSERT_THAT(Lines(found), SizeIs(1));
  EXPECT_THAT(Lines(found)[0].at("objects"), SizeIs(2));
}

TEST_F(LogViewsTest, ShowsChannelsAndTheLatestMessage) {
  const Outcome outcome = Tool({"top", log_, "--speed", "100", "--channel", "OBJECTS"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(ContainsRegex("  TABLETOP +tabletop_t +2 "),
                                 ContainsRegex("> OBJECTS +object_list_t +2 "),
                                 HasSubstr("  frame \"b\"\n"), HasSubstr("  shape[2] ")));
}

TEST_F(LogViewsTest, ShowsWhatComesOverANetwork) {
  const Outcome doctor = RunLauncher({"doctor"}, folder_);
  if (doctor.out.find("ok  multicast") == std::string::npos) GTEST_SKIP() << doctor.out;
  const std::string url =
      "udpm://239.255.76.67:" + std::to_string(32'700 + getpid() % 60) + "?ttl=0";
  const TemporaryFolder playing;
  Launched player({Program("log_tool"), "play", log_, "--loop", "--url", url}, playing);
  const Outcome outcome = Tool({"top", "--url", url, "--seconds", "3"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, ContainsRegex("OBJECTS +object_list_t +[1-9]"));
}

TEST_F(LogViewsTest, LetsAKeyChooseTheChannelAndEndIt) {
  const Terminal terminal;
  const tcflag_t before = terminal.Mode();
  Launched top({Program("log_tool"), "top", log_, "--speed", "0.01"}, folder_, terminal.AsStdin());
  ASSERT_TRUE(Eventually([&] { return terminal.Mode() != before; }));
  for (const char key : {'j', ' ', 'n', 'n', 'q'}) terminal.Press(key);
  const Outcome outcome = top.Wait();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("  channel "));
  EXPECT_EQ(terminal.Mode(), before);
}

TEST_F(LogViewsTest, LeavesTheTerminalAsItWasAfterASignal) {
  const Terminal terminal;
  const tcflag_t before = terminal.Mode();
  Launched top({Program("log_tool"), "top", log_, "--speed", "0.01"}, folder_, terminal.AsStdin());
  ASSERT_TRUE(Eventually([&] { return terminal.Mode() != before; }));
  top.Signal(SIGINT);
  EXPECT_EQ(top.Wait().code, 128 + SIGINT);
  EXPECT_EQ(terminal.Mode(), before);
}

TEST_F(LogViewsTest, TellsWhatCannotBeShown) {
  const std::string part = folder_.Path("part.lcm"), pictures = folder_.Path("pictures");
  ASSERT_EQ(Tool({"cut", log_, part, "--channels", "MODULE_STATUS"}).code, 0);
  for (const std::string verb : {"to_pictures", "to_pcd"}) {
    const Outcome outcome = Tool({verb, part, pictures});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("part.lcm: no message on "));
    EXPECT_EQ(Tool({verb, log_}).code, 2);
    EXPECT_EQ(Tool({verb, log_, folder_.Write("file", "")}).code, 1);
  }
  fs::resize_file(log_, fs::file_size(log_) / 2);
  const Outcome cut_off = Tool({"to_pcd", log_, folder_.Path("clouds")});
  EXPECT_EQ(cut_off.code, 1);
  EXPECT_THAT(cut_off.err, HasSubstr("run.lcm: cut off after"));
}

TEST_F(LogViewsTest, LeavesNoHalfFileOnAFullDisk) {
  const auto fill_disk = [] {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit = {10'000, 10'000};
    setrlimit(RLIMIT_FSIZE, &limit);
  };
  for (const std::string verb : {"to_pictures", "to_pcd"}) {
    const std::string files = folder_.Path(verb);
    const Outcome outcome = Tool({verb, log_, files}, fill_disk);
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, ContainsRegex("a\\.(overlay\\.png|pcd): .*File too large"));
    EXPECT_THAT(FilesIn(files), testing::IsEmpty());
  }
  const std::string part = folder_.Path("part.lcm");
  const Outcome cut = Tool({"cut", log_, part}, fill_disk);
  EXPECT_EQ(cut.code, 1);
  EXPECT_THAT(cut.err, HasSubstr("part.lcm: cannot be written (File too large)"));
  EXPECT_FALSE(fs::exists(part));
}

}  // namespace
}  // namespace declutter
