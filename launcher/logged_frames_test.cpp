#include "launcher/logged_frames.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace declutter::launcher {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class LoggedFramesTest : public testing::Test {
 protected:
  LoggedFramesTest()
      : path_(std::filesystem::temp_directory_path() /
              ("logged_frames_test_" + std::to_string(getpid()))) {}
  ~LoggedFramesTest() override { std::filesystem::remove(path_); }

  // Each event is a channel and the utime of its message.
  void WriteLog(const std::vector<std::pair<std::string, uint8_t>>& events) {
    runtime::EventLogWriter writer(path_);
    for (const auto& [channel, utime] : events) {
      runtime::Bytes message(16);
      message[15] = utime;
      writer.Write({0, channel, message});
    }
  }

  std::vector<std::string> ReadLog() {
    LoggedFrames frames(path_, {"DEPTH", "COLOR"});
    std::vector<std::string> texts;
    while (const auto frame = frames.Next()) {
      std::string text = std::to_string(frame->utime) + ":";
      for (const Message& message : frame->messages) text += " " + message.channel;
      texts.push_back(text);
    }
    damage_ = frames.damage();
    return texts;
  }

  std::string path_;
  std::string damage_;
};

TEST_F(LoggedFramesTest, CollectsTheMessagesOfAFrameAcrossThoseOfOthers) {
  WriteLog({{"DEPTH", 1}, {"DEPTH", 2}, {"COLOR", 2}, {"COLOR", 1}, {"DEPTH", 3}});
  EXPECT_THAT(ReadLog(), ElementsAre("1: DEPTH COLOR", "2: DEPTH COLOR", "3: DEPTH"));
  EXPECT_THAT(damage_, IsEmpty());
}

TEST_F(LoggedFramesTest, LeavesOutOtherChannelsAndMessagesSentAgain) {
  WriteLog({{"DEPTH", 1}, {"MODULE_STATUS", 9}, {"DEPTH", 1}, {"COLOR", 1}});
  EXPECT_THAT(ReadLog(), ElementsAre("1: DEPTH COLOR"));
}

TEST_F(LoggedFramesTest, ReadsADamagedLogUpToTheDamageAndSaysWhere) {
  WriteLog({{"DEPTH", 1}, {"DEPTH", 2}});
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) - 1);
  EXPECT_THAT(ReadLog(), ElementsAre("1: DEPTH"));
  EXPECT_THAT(damage_, HasSubstr("cut off after 1 events"));
}

TEST_F(LoggedFramesTest, RefusesALogWithoutTheChannels) {
  WriteLog({{"TABLETOP", 1}});
  EXPECT_THROW(LoggedFrames(path_, {"DEPTH"}), std::runtime_error);
}

}  // namespace
}  // namespace declutter::launcher
