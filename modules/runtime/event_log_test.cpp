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

TEST_F(EventLog, GoesOnBehindADamagedHeader) {
  constexpr int kNumEvents = 4;
  constexpr int kHeader = 28, kEvent = kHeader + 7 + 3;
  for (int byte = 0; byte < kHeader * 8; ++byte) {
    std::filesystem::remove(path_);
    {
      EventLogWriter writer(path_);
      for (int i = 0; i < kNumEvents; ++i) writer.Write({i, "OBJECTS", {1, 2, 3}});
    }
    // One bit of the header of the second event.
    std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(kEvent + byte / 8);
    const int value = file.get();
    file.seekp(kEvent + byte / 8);
    file.put(static_cast<char>(value ^ (1 << byte % 8)));
    file.close();

    EventLogReader reader(path_);
    std::vector<std::int64_t> utimes;
    for (bool goes_on = true; goes_on;) {
      try {
        const auto event = reader.Next();
        goes_on = event.has_value();
        if (event && event->channel == "OBJECTS" && event->message.size() == 3) {
          utimes.push_back(event->utime);
        }
      } catch (const std::runtime_error&) {
        goes_on = reader.SkipDamage();
      }
    }
    // The other three are always found, in order.
    EXPECT_THAT(utimes, testing::IsSupersetOf({0, 2, 3})) << "bit " << byte;
    EXPECT_LE(utimes.size(), 4u) << "bit " << byte;
  }
}

TEST_F(EventLog, ReportsAFileThatIsNotALog) {
  std::ofstream(path_) << "a text that is longer than the header of an event";
  EXPECT_THAT(ReadFault(), HasSubstr("is not an LCM log"));
}

}  // namespace
}  // namespace declutter::runtime
