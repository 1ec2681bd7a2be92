#include "launcher/log_tool/frame_summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "launcher/wire.h"
#include "modules/runtime/event_log.h"

namespace declutter::log_tool {
namespace {

using testing::DoubleEq;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Key;

class FrameSummaryTest : public testing::Test {
 protected:
  FrameSummaryTest() { std::filesystem::remove(path_); }
  ~FrameSummaryTest() override { std::filesystem::remove(path_); }

  struct Record {
    int64_t recorded_us;
    std::string channel;
    int64_t utime;
  };

  FrameSummary SummaryOf(const std::vector<Record>& records) {
    runtime::EventLogWriter writer(path_);
    for (const Record& record : records) {
      object_list_t message = {};
      message.utime = record.utime;
      writer.Write({record.recorded_us, record.channel, launcher::Encode(kObjects, message).bytes});
    }
    return SummariseFrames(path_);
  }

  const std::string path_ = testing::TempDir() + "frame_summary_test.lcmlog";
};

TEST_F(FrameSummaryTest, TellsHowLongAfterItsDepthAFramesMessagesCame) {
  const FrameSummary summary = SummaryOf({{1'000'000, "COLOR_FRAME", 7},
                                          {1'001'000, "DEPTH_FRAME", 7},
                                          {1'034'000, "DEPTH_FRAME", 8},
                                          {1'061'000, "OBJECTS", 7},
                                          {1'074'000, "OBJECTS", 8},
                                          {1'090'000, "OBJECTS", 6}});
  EXPECT_EQ(summary.num_frames, 2);
  EXPECT_DOUBLE_EQ(summary.span_s, 0.033);
  EXPECT_THAT(summary.delays_ms, ElementsAre(Key("OBJECTS")));
  EXPECT_THAT(summary.delays_ms.at("OBJECTS"), ElementsAre(DoubleEq(40), DoubleEq(60)));
  EXPECT_THAT(Text(summary),
              HasSubstr("OBJECTS                     2     40.0     60.0     60.0     60.0"));
}

TEST_F(FrameSummaryTest, CountsAFrameOnceThatWasSentAgain) {
  const FrameSummary summary = SummaryOf({{1'000'000, "DEPTH_FRAME", 7},
                                          {2'000'000, "DEPTH_FRAME", 7},
                                          {2'500'000, "OBJECTS", 7},
                                          {2'600'000, "OBJECTS", 7}});
  EXPECT_EQ(summary.num_frames, 1);
  EXPECT_THAT(summary.delays_ms.at("OBJECTS"), ElementsAre(DoubleEq(1500)));
}

TEST_F(FrameSummaryTest, TakesTheLastStatusOfEachModuleAndNoneOfTheLauncher) {
  {
    runtime::EventLogWriter writer(path_);
    module_status_t status = {};
    const auto write = [&](const std::string& module, int64_t num_in) {
      status.module = module;
      status.num_in = num_in;
      status.num_skipped = 3;
      writer.Write({1, "MODULE_STATUS", launcher::Encode(kModuleStatus, status).bytes});
    };
    write("plane_filter", 5);
    write("launcher", 0);
    write("plane_filter", 11);
  }
  const FrameSummary summary = SummariseFrames(path_);
  EXPECT_THAT(summary.modules, ElementsAre(Key("plane_filter")));
  EXPECT_THAT(Text(summary), HasSubstr("plane_filter               11        0        3"));
}

TEST_F(FrameSummaryTest, CountsWhatAllProcessesOfAModulePublishedAndWhatIsThere) {
  {
    runtime::EventLogWriter writer(path_);
    module_status_t status = {};
    status.module = "plane_filter";
    const auto write = [&](int32_t pid, int64_t num_messages) {
      status.pid = pid;
      status.num_messages = num_messages;
      writer.Write({1, "MODULE_STATUS", launcher::Encode(kModuleStatus, status).bytes});
    };
    write(7, 1);
    write(7, 2);
    write(8, 1);
    const auto message = launcher::Encode(kTabletop, tabletop_t{});
    for (int i = 0; i < 3; ++i) writer.Write({1, "TABLETOP", message.bytes});
    writer.Write({1, "RUN_INFO", launcher::Encode(kRunInfo, run_info_t{}).bytes});
  }
  const FrameSummary summary = SummariseFrames(path_);
  EXPECT_EQ(summary.num_published, 3);
  EXPECT_EQ(summary.num_logged, 3);
  EXPECT_THAT(Text(summary), HasSubstr("\n3 messages published by modules, 3 in the log\n"));
}

TEST_F(FrameSummaryTest, TellsOfDamageAndGoesOn) {
  SummaryOf({{1, "DEPTH_FRAME", 7}, {2, "OBJECTS", 7}, {3, "OBJECTS", 8}});
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) - 1);
  const FrameSummary summary = SummariseFrames(path_);
  EXPECT_EQ(summary.num_frames, 1);
  EXPECT_THAT(summary.damages, testing::SizeIs(1));
  EXPECT_THAT(summary.modules, IsEmpty());
}

TEST_F(FrameSummaryTest, RefusesAFileThatCannotBeRead) {
  EXPECT_THROW(SummariseFrames(path_ + ".none"), std::runtime_error);
}

TEST(PercentileTest, IsTheSmallestValueThatTheShareDoesNotExceed) {
  EXPECT_EQ(Percentile({1, 2, 3, 4}, 0.5), 2);
  EXPECT_EQ(Percentile({1, 2, 3, 4}, 0.51), 3);
  EXPECT_EQ(Percentile({1, 2, 3, 4}, 1.0), 4);
  EXPECT_EQ(Percentile({5}, 0.01), 5);
}

}  // namespace
}  // namespace declutter::log_tool
