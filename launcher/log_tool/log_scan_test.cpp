#include "launcher/log_tool/log_scan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "launcher/wire.h"

namespace declutter::log_tool {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class LogScanTest : public testing::Test {
 protected:
  ~LogScanTest() override { std::filesystem::remove(path_); }

  template <typename Message>
  static runtime::Bytes Encoded(const Message& message) {
    return launcher::Encode(Channel<Message>{""}, message).bytes;
  }

  // Objects every 0.1 s, and at the end something foreign.
  void WriteLog(int num_objects) {
    std::filesystem::remove(path_);
    runtime::EventLogWriter writer(path_);
    run_info_t info = {};
    info.versions = "plane_filter 0.1.0\n";
    info.graph = "module { }\n";
    writer.Write({1'000'000, "RUN_INFO", Encoded(info)});
    for (int i = 0; i < num_objects; ++i) {
      object_list_t objects = {};
      objects.utime = i;
      writer.Write({1'000'000 + i * 100'000, "OBJECTS", Encoded(objects)});
    }
    writer.Write({1'000'000 + num_objects * 100'000, "FOREIGN", {1, 2, 3}});
  }

  const std::string path_ = testing::TempDir() + "log_scan_test.lcmlog";
};

TEST_F(LogScanTest, TellsWhatALogHolds) {
  WriteLog(11);
  const LogSummary summary = Summarise(path_);
  EXPECT_THAT(summary.channels, SizeIs(3));
  const ChannelSummary& objects = summary.channels.at("OBJECTS");
  EXPECT_EQ(objects.type, "object_list_t");
  EXPECT_EQ(objects.num_messages, 11);
  EXPECT_NEAR(objects.max_gap_s, 0.1, 1e-9);
  EXPECT_NEAR(objects.last_s - objects.first_s, 1.0, 1e-9);
  EXPECT_EQ(summary.channels.at("FOREIGN").type, "?");
  EXPECT_EQ(summary.versions, "plane_filter 0.1.0\n");
  EXPECT_EQ(summary.graph, "module { }\n");
  EXPECT_THAT(summary.damages, IsEmpty());
  EXPECT_THAT(Text(summary),
              HasSubstr("OBJECTS              object_list_t            11     10.0"));
  EXPECT_THAT(Text(summary), HasSubstr("\n? is no type of this version\n"));
}

TEST_F(LogScanTest, CountsMessagesThatCannotBeDecodedAndTimesThatGoBack) {
  {
    runtime::EventLogWriter writer(path_);
    runtime::Bytes objects = Encoded(object_list_t{});
    writer.Write({2, "OBJECTS", objects});
    objects.pop_back();
    writer.Write({1, "OBJECTS", objects});
  }
  const LogSummary summary = Summarise(path_);
  EXPECT_EQ(summary.channels.at("OBJECTS").num_damaged, 1);
  EXPECT_EQ(summary.num_backward, 1);
  EXPECT_THAT(Text(summary), HasSubstr("the clock went back 1 times"));
}

TEST_F(LogScanTest, ReadsWhatIsWholeOfALogThatIsCutAnywhere) {
  WriteLog(3);
  for (auto size = std::filesystem::file_size(path_) - 1; size > 0; --size) {
    std::filesystem::resize_file(path_, size);
    int64_t num_bytes = 0, num_events = 0;
    const auto damages = ForEachEvent(path_, [&](const runtime::LogEvent& event, double) {
      num_bytes += 28 + static_cast<int64_t>(event.channel.size() + event.message.size());
      ++num_events;
    });
    EXPECT_LE(num_events, 4);
    EXPECT_EQ(damages.empty(), num_bytes == static_cast<int64_t>(size));
  }
}

TEST_F(LogScanTest, FindsTheOtherEventsWhenAnyByteIsChanged) {
  WriteLog(4);
  std::ifstream whole(path_, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(whole), {}};
  for (size_t i = 0; i < bytes.size(); ++i) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(~damaged[i]);
    std::ofstream(path_, std::ios::binary | std::ios::trunc) << damaged;
    std::vector<std::string> channels;
    ForEachEvent(
        path_, [&](const runtime::LogEvent& event, double) { channels.push_back(event.channel); });
    EXPECT_GE(channels.size(), 5u) << "byte " << i;
    EXPECT_LE(channels.size(), 6u) << "byte " << i;
  }
}

TEST_F(LogScanTest, RefusesAFileThatCannotBeRead) {
  EXPECT_THROW(Summarise(path_ + ".none"), std::runtime_error);
}

TEST_F(LogScanTest, GivesTheSameMessagesTheSameHash) {
  WriteLog(3);
  const uint64_t hash = Summarise(path_).channels.at("OBJECTS").hash;
  WriteLog(3);
  EXPECT_EQ(Summarise(path_).channels.at("OBJECTS").hash, hash);
  WriteLog(4);
  EXPECT_NE(Summarise(path_).channels.at("OBJECTS").hash, hash);
}

}  // namespace
}  // namespace declutter::log_tool
