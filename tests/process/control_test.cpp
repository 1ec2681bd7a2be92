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
  EXPECT_TRUE(Eventually([this] {
    std::istringstream words(Row("filter"));
    const std::vector<std::string> columns{std::istream_iterator<std::string>(words), {}};
    return columns.size() == 14 && std::stod(columns[11]) > 25 && std::stod(columns[11]) < 75;
  })) << Row("filter");
  End();
}

TEST_F(ControlTest, StopsAndStartsAModuleWhileTheRestRuns) {
  Run("", "");
  ASSERT_EQ(Ask({"stop", "filter"}).code, 0);
  EXPECT_THAT(Row("filter"), ContainsRegex("filter +stopped +0 "));
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

TEST_F(ControlTest, PrintsWhatAModuleHasSaid) {
  Run("",
      FilterConfig("mishap: \"gets_stuck\" at_frame: 3") + " grace_period_s: 0.2 required: false");
  ASSERT_TRUE(Eventually([this] { return Ask({"logs", "filter"}).out == "filter: stuck\n"; }));
  const Outcome unknown = Ask({"logs", "fliter"});
  EXPECT_EQ(unknown.code, 1);
  EXPECT_THAT(unknown.err, HasSubstr("fliter.log: there is no such log"));
  Launched follower({LAUNCHER, "logs", "filter", "-f", "--run", folder_.Path("logs/latest")},
                    asking_);
  End();
  const Outcome followed = follower.Wait();
  EXPECT_EQ(followed.code, 0);
  EXPECT_EQ(followed.out, "filter: stuck\n");
}

}  // namespace
}  // namespace declutter
