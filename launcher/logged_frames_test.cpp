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
    int64_t time_us = 0;
    for (const auto& [channel, utime] : events) {
      runtime::Bytes message(16);
      message[15] = utime;
      writer.Write({time_us += 100'000, channel, message});
    }
  }

  std::vector<std::string> ReadLog() {
    LoggedFrames frames(path_, {{"DEPTH", "depth_t"}, {"COLOR", "color_t"}}, needed_, part_);
    std::vector<std::string> texts;
    while (const auto frame = frames.Next()) {
      std::string text = std::to_string(frame->utime) + ":";
      for (const Message& message : frame->messages) text += " " + message.channel;
      texts.push_back(text);
    }
    damage_ = frames.damage();
    left_out_ = frames.left_out();
    return texts;
  }

  std::string path_;
  std::set<std::string> needed_;
  Excerpt part_;
  std::string damage_;
  std::string left_out_;
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

TEST_F(LoggedFramesTest, LosesNoFrameWithoutATraceWhateverByteOfAHeaderIsChanged) {
  WriteLog({{"DEPTH", 1}, {"COLOR", 1}, {"DEPTH", 2}, {"COLOR", 2}});
  std::ifstream file(path_, std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(file), {}};
  constexpr size_t kHeaderBytes = 28;
  const size_t event_bytes = whole.size() / 4;
  for (size_t i = 0; i < whole.size(); ++i) {
    if (i % event_bytes >= kHeaderBytes) continue;
    std::string damaged = whole;
    damaged[i] = static_cast<char>(~damaged[i]);
    std::ofstream(path_, std::ios::binary | std::ios::trunc) << damaged;
    try {
      const bool is_whole =
          ReadLog() == std::vector<std::string>{"1: DEPTH COLOR", "2: DEPTH COLOR"};
      EXPECT_NE(is_whole, !damage_.empty()) << "byte " << i;
    } catch (const std::runtime_error&) {  // nothing is left that could be read
      EXPECT_LT(i, event_bytes);
    }
  }
}

TEST_F(LoggedFramesTest, RefusesALogWithoutTheChannels) {
  WriteLog({{"TABLETOP", 1}});
  EXPECT_THROW(ReadLog(), std::runtime_error);
}

TEST_F(LoggedFramesTest, ReadsFramesThatBeginInAPart) {
  WriteLog({{"DEPTH", 1}, {"DEPTH", 2}, {"COLOR", 1}, {"DEPTH", 3}, {"COLOR", 2}, {"DEPTH", 4}});
  part_.start_s = 0.05;
  part_.end_s = 0.35;
  EXPECT_THAT(ReadLog(), ElementsAre("2: DEPTH COLOR", "3: DEPTH"));
  part_.start_s = part_.end_s = 9.0;
  EXPECT_THROW(ReadLog(), std::runtime_error);
}

TEST_F(LoggedFramesTest, LeavesOutFramesThatLackWhatIsNeededAndSaysSo) {
  WriteLog({{"DEPTH", 1}, {"DEPTH", 2}, {"COLOR", 2}, {"COLOR", 3}});
  EXPECT_THAT(ReadLog(), ElementsAre("1: DEPTH", "2: DEPTH COLOR", "3: COLOR"));
  EXPECT_THAT(left_out_, IsEmpty());
  needed_ = {"DEPTH", "COLOR"};
  EXPECT_THAT(ReadLog(), ElementsAre("2: DEPTH COLOR"));
  EXPECT_EQ(left_out_, "2 of 3 frames of the log have no message on COLOR or DEPTH");
  needed_ = {"TABLETOP"};
  EXPECT_THROW(ReadLog(), std::runtime_error);
}

TEST_F(LoggedFramesTest, NamesChannelAndTypeWhenAllMessagesAreOfAnotherVersion) {
  WriteLog({{"DEPTH", 1}, {"TABLETOP", 1}});
  const auto fault = [this](const std::map<std::string, std::string>& types) -> std::string {
    try {
      LoggedFrames(path_, types, {}, {});
      return "none";
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  };
  EXPECT_THAT(fault({{"TABLETOP", "tabletop_t"}}),
              HasSubstr("on TABLETOP is not a tabletop_t of this version (fingerprint 0x0000"));
  EXPECT_EQ(fault({{"TABLETOP", "of_another_project_t"}}), "none");
}

}  // namespace
}  // namespace declutter::launcher
