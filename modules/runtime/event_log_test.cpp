#include "modules/runtime/event_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "modules/runtime/config_error.h"

namespace declutter::runtime {
namespace {

using testing::HasSubstr;

class EventLog : public testing::Test {
 protected:
  EventLog() { std::filesystem::remove(path_); }
  ~EventLog() override { std::filesystem::remove(path_); }

  void WriteTwoEvents() {
    EventLogWriter writer(path_);
    writer.Write({100, "TABLETOP", {1, 2, 3}});
    writer.Write({-5, "OBJECTS", {}});
  }

  std::string ReadFault() {
    try {
      EventLogReader reader(path_);
      while (reader.Next()) {
      }
      return "none";
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  }

  const std::string path_ = testing::TempDir() + "event_log_test.lcmlog";
};

TEST_F(EventLog, GivesBackWhatWasWritten) {
  WriteTwoEvents();
  EventLogReader reader(path_);
  const std::optional<LogEvent> first = reader.Next();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->utime, 100);
  EXPECT_EQ(first->channel, "TABLETOP");
  EXPECT_EQ(first->message, (Bytes{1, 2, 3}));
  EXPECT_EQ(reader.Next()->utime, -5);
  EXPECT_FALSE(reader.Next());
}

TEST_F(EventLog, IsNeverOverwritten) {
  WriteTwoEvents();
  EXPECT_THROW(EventLogWriter{path_}, ConfigError);
  EXPECT_EQ(ReadFault(), "none");
}

TEST_F(EventLog, ReportsAMissingOrEmptyFile) {
  EXPECT_THAT(ReadFault(), HasSubstr("cannot be read"));
  std::ofstream(path_).close();
  EXPECT_THAT(ReadFault(), HasSubstr("holds no events"));
}

TEST_F(EventLog, ReportsWhereItIsCutOffWhereverThatIs) {
  WriteTwoEvents();
  const auto first_bytes = 28 + 8 + 3;
  for (auto size = std::filesystem::file_size(path_) - 1; size > 0; --size) {
    std::filesystem::resize_file(path_, size);
    const std::string fault = ReadFault();
    if (size == first_bytes) {
      EXPECT_EQ(fault, "none");
    } else if (size > first_bytes) {
      EXPECT_THAT(fault, HasSubstr("cut off after 1 events (byte 39)"));
    } else {
      EXPECT_THAT(fault, HasSubstr("cut off after 0 events (byte 0)"));
    }
  }
}

TEST_F(EventLog, ReportsAFileThatIsNotALog) {
  std::ofstream(path_) << "a text that is longer than the header of an event";
  EXPECT_THAT(ReadFault(), HasSubstr("is not an LCM log"));
}

}  // namespace
}  // namespace declutter::runtime
