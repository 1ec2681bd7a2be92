#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>
#include <sstream>

#include "tests/process/fake_graph.h"
#include "tests/process/launched.h"

namespace declutter {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// A camera of 50 Hz and a filter, and what a user asks of them while they run.
class ControlTest : public testing::Test {
 protected:
  void Run(const std::string& source_fields, const std::string& filter_fields) {
    launcher_.emplace(
        std::vector<std::string>{LAUNCHER, "run", LiveGraph(folder_, source_fields, filter_fields),
                                 "--log_dir", folder_.Path("logs"), "--record", log_},
        folder_);
    ASSERT_TRUE(Eventually([this] { return Row("source").find(" running ") != std::string::npos; }))
        << ReadFile(folder_.Path("stderr"));
  }

  Outcome Ask(std::vector<std::string> words) const {
    words.insert(words.begin(), LAUNCHER);
    words.insert(words.end(), {"--run", folder_.Path("logs/latest")});
    return Launched(words, asking_).Wait();
  }

  std::string Row(const std::string& process) const {
    const std::string table = Ask({"status"}).out;
    const size_t begin = table.find("\n" + process + " ");
    return begin == std::string::npos ? ""
                                      : table.substr(begin, table.find('\n', begin + 1) - begin);
  }

  // A number from the table; 0 where there is none yet.
  double Column(const std::string& process, const std::string& name) const {
    const std::string table = Ask({"status"}).out;
    std::istringstream lines(table);
    std::vector<std::string> head;
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      const std::vector<std::string> row{std::istream_iterator<std::string>(words), {}};
      if (head.empty()) head = row;
      if (row.empty() || row[0] != process) continue;
      const auto column = std::find(head.begin(), head.end(), name) - head.begin();
      return std::atof(row.at(static_cast<size_t>(column)).c_str());
    }
    return 0;
  }

  Outcome End() {
    launcher_->Signal(SIGTERM);
    const Outcome outcome = launcher_->Wait();
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(Eventually([this] { return ProcessesWith(folder_.Path("")).empty(); }));
    return outcome;
  }

  bool HasObjects(size_t num) const {
    return Eventually([&] { return UtimesOf("OBJECTS", log_).size() >= num; });
  }

  // Of the frames of the camera from the first answered to the last, those not answered once.
  int NumLostOrDoubled() const {
    const auto objects = UtimesOf("OBJECTS", log_);
    const std::multiset<int64_t> answered(objects.begin(), objects.end());
    int num = 0;
    for (const int64_t utime : UtimesOf("DEPTH_FRAME", log_)) {
      const bool is_between = utime >= *answered.begin() && utime <= *answered.rbegin();
      if (is_between && answered.count(utime) != 1) ++num;
    }
    return num;
  }

  TemporaryFolder folder_;
  TemporaryFolder asking_;
  std::string log_ = folder_.Path("run.lcm");
  std::optional<Launched> launcher_;
};

TEST_F(ControlTest, ShowsHowEachProcessDoes) {
  Run("", "");
  EXPECT_THAT(Ask({"status"}).out, ContainsRegex("^process +state +pid +restarts"));
  EXPECT_THAT(Row("filter"), ContainsRegex("filter +running +[1-9][0-9]* +0 +0:00:"));
  EXPECT_THAT(Row("lcm-logger"), HasSubstr("running"));
  // A camera of 50 Hz; it knows how long the whole graph takes, the filter only how long it does.
  EXPECT_TRUE(Eventually([this] {
    const double source_ms = Column("source", "latency"), filter_ms = Column("filter", "latency");
    return Column("filter", "Hz") > 25 && Column("filter", "Hz") < 75 && filter_ms > 0 &&
           filter_ms < source_ms;
  })) << Ask({"status"}).out;
  EXPECT_THAT(Ask({"status"}).out, AllOf(HasSubstr("\nudpm://239.255.76.67:"),
                                         HasSubstr(", logs in " + folder_.Path("logs/20"))));
  End();
}

TEST_F(ControlTest, ShowsTheTableAgainEverySecondUntilTheGraphEnds) {
  Run("", "");
  Launched watch({LAUNCHER, "status", "--watch", "--run", folder_.Path("logs/latest")}, asking_);
  const auto num_tables = [this] {
    const std::string text = ReadFile(asking_.Path("stdout"));
    int num = 0;
    for (size_t at = 0; (at = text.find("process ", at)) != std::string::npos; ++at) ++num;
    return num;
  };
  EXPECT_TRUE(Eventually([&] { return num_tables() >= 2; }));
  End();
  EXPECT_EQ(watch.Wait().code, 0);
}

TEST_F(ControlTest, StopsAndStartsAModuleWhileTheRestRuns) {
  Run("", "");
  ASSERT_EQ(Ask({"stop", "filter"}).code, 0);
  EXPECT_THAT(Row("filter"), ContainsRegex("filter +stopped +- "));
  EXPECT_THAT(ModulesOf("fake_filter"), IsEmpty());
  ASSERT_EQ(Ask({"start", "filter"}).code, 0);
  EXPECT_THAT(Row("filter"), ContainsRegex("filter +running +[1-9][0-9]* +1 "));
  End();
}

TEST_F(ControlTest, RestartsAModuleAsAnotherProcess) {
  Run("", "");
  const auto before = ModulesOf("fake_filter");
  ASSERT_EQ(Ask({"restart", "filter"}).code, 0);
  const auto after = ModulesOf("fake_filter");
  ASSERT_EQ(after.size(), 1u);
  EXPECT_NE(before, after);
  End();
}

TEST_F(ControlTest, SaysWhenAModuleDoesNotComeUp) {
  Run("", "required: false " + FilterConfig("mishap: \"crashes\" at_frame: 3"));
  ASSERT_TRUE(Eventually([this] { return Row("filter").find(" ended ") != std::string::npos; }));
  EXPECT_EQ(Ask({"stop", "filter"}).code, 0);
  End();
}

TEST_F(ControlTest, RefusesAModuleThatTheGraphDoesNotHave) {
  Run("", "");
  const Outcome outcome = Ask({"stop", "fliter"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("no module named 'fliter'; did you mean 'filter'?"));
  End();
}

TEST_F(ControlTest, SaysWhenNoGraphRuns) {
  const Outcome outcome = Ask({"status"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("no graph has run there"));
  Run("", "");
  End();
  EXPECT_THAT(Ask({"status"}).err, HasSubstr("no graph runs there"));
}

TEST_F(ControlTest, SwapsAModuleWithoutLosingOrDoublingAFrame) {
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

TEST_F(ControlTest, KeepsTheOldModuleWhenTheNewOneNeverGetsReady) {
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

TEST_F(ControlTest, StartsTheOldModuleAgainWhenTheNewOneFailsAtItsFirstFrame) {
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

TEST_F(ControlTest, RefusesToSwapInWhatDoesNotFit) {
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

TEST_F(ControlTest, SwapsInAProgramWithParametersOfItsOwn) {
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

TEST_F(ControlTest, PrintsWhatAModuleHasSaid) {
  Run("",
      FilterConfig("mishap: \"gets_stuck\" at_frame: 3") + " grace_period_s: 0.2 required: false");
  ASSERT_TRUE(Eventually([this] { return Ask({"logs", "filter"}).out == "filter: stuck\n"; }));
  const Outcome unknown = Ask({"logs", "fliter"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("nothing named 'fliter' has run there; did you mean "
                                     "'filter'?"));
  EXPECT_THAT(Ask({"logs", "launcher"}).out, HasSubstr(", logs in "));
  Launched follower({LAUNCHER, "logs", "filter", "-f", "--run", folder_.Path("logs/latest")},
                    asking_);
  End();
  const Outcome followed = follower.Wait();
  EXPECT_EQ(followed.code, 0);
  EXPECT_EQ(followed.out, "filter: stuck\n");
}

}  // namespace
}  // namespace declutter
