#include "modules/runtime/replay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "modules/runtime/bus.h"
#include "modules/runtime/config_error.h"
#include "modules/runtime/event_log.h"

namespace declutter::runtime {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

template <typename Message>
Bytes EncodedAt(std::int64_t utime) {
  Message message{};
  message.utime = utime;
  Bytes bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

class ReplayTest : public testing::Test {
 protected:
  ReplayTest() { std::filesystem::create_directories(folder_); }
  ~ReplayTest() override { std::filesystem::remove_all(folder_); }

  void WriteLog(const std::vector<LogEvent>& events) {
    EventLogWriter writer(in_);
    for (const LogEvent& event : events) writer.Write(event);
  }

  // Replays a module that answers each tabletop with features of the same time.
  void ReplayAnswering() {
    Publisher<feature_cloud_t> features = bus_.Advertise(kFeatures);
    bus_.Subscribe(kTabletop, [this, features](const tabletop_t& tabletop) {
      if (tabletop.utime == kUnwanted) throw std::runtime_error("unwanted");
      utimes_.push_back(tabletop.utime);
      feature_cloud_t answer{};
      answer.utime = tabletop.utime;
      features.Publish(answer);
    });
    Replay(in_, out_, &shell_);
  }

  std::string ReplayFault() {
    try {
      ReplayAnswering();
      return "none";
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  }

  static constexpr std::int64_t kUnwanted = 666;
  const std::string folder_ = testing::TempDir() + "replay_test/";
  const std::string in_ = folder_ + "in.lcmlog";
  const std::string out_ = folder_ + "out.lcmlog";
  Shell shell_{{"module", "module", {}, true}};
  Bus bus_{&shell_};
  std::vector<std::int64_t> utimes_;
};

TEST_F(ReplayTest, AnswersEveryFrameAtTheTimeOfItsEvent) {
  WriteLog({{1000, "TABLETOP", EncodedAt<tabletop_t>(1)},
            {2000, "OBJECTS", EncodedAt<object_list_t>(1)},
            {3000, "TABLETOP", EncodedAt<tabletop_t>(2)}});
  ReplayAnswering();
  EventLogReader answers(out_);
  const std::optional<LogEvent> first = answers.Next();
  const std::optional<LogEvent> second = answers.Next();
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->utime, 1000);
  EXPECT_EQ(first->channel, "FEATURES");
  EXPECT_EQ(first->message, EncodedAt<feature_cloud_t>(1));
  EXPECT_EQ(second->utime, 3000);
  EXPECT_EQ(second->message, EncodedAt<feature_cloud_t>(2));
  EXPECT_FALSE(answers.Next());
}

TEST_F(ReplayTest, DropsDamagedMessagesAndGoesOn) {
  Bytes damaged = EncodedAt<tabletop_t>(2);
  damaged.pop_back();
  WriteLog({{1, "TABLETOP", EncodedAt<tabletop_t>(1)},
            {2, "TABLETOP", damaged},
            {3, "TABLETOP", EncodedAt<object_list_t>(3)},
            {4, "TABLETOP", EncodedAt<tabletop_t>(kUnwanted)},
            {5, "TABLETOP", EncodedAt<tabletop_t>(5)}});
  ReplayAnswering();
  EXPECT_THAT(utimes_, ElementsAre(1, 5));
  EXPECT_EQ(shell_.num_rejected(), 3);
}

TEST_F(ReplayTest, JoinsTheMessagesOfAFrame) {
  WriteLog({{1, "TABLETOP", EncodedAt<tabletop_t>(1)},
            {2, "TABLETOP", EncodedAt<tabletop_t>(2)},
            {3, "FEATURES", EncodedAt<feature_cloud_t>(2)},
            {4, "FEATURES", EncodedAt<feature_cloud_t>(1)}});
  bus_.SubscribeJoined(kTabletop, kFeatures,
                       [this](const tabletop_t& tabletop, const feature_cloud_t& features) {
                         EXPECT_EQ(tabletop.utime, features.utime);
                         utimes_.push_back(tabletop.utime);
                       });
  Replay(in_, "", &shell_);
  EXPECT_THAT(utimes_, ElementsAre(2, 1));
}

TEST_F(ReplayTest, LeavesOutFramesThatWereSkippedWhenTheLogWasMade) {
  std::vector<LogEvent> events;
  for (int i = 1; i <= 500; ++i) {
    events.push_back({i, "TABLETOP", EncodedAt<tabletop_t>(i)});
    if (i % 100 == 0) events.push_back({i, "FEATURES", EncodedAt<feature_cloud_t>(i)});
  }
  WriteLog(events);
  bus_.SubscribeJoined(kTabletop, kFeatures, [this](const tabletop_t& tabletop, const auto&) {
    utimes_.push_back(tabletop.utime);
  });
  Replay(in_, "", &shell_);
  EXPECT_THAT(utimes_, ElementsAre(100, 200, 300, 400, 500));
  EXPECT_EQ(shell_.num_left_out(), 495);
  EXPECT_FALSE(shell_.failed());
}

TEST_F(ReplayTest, ProcessesEveryCompleteEventOfALogThatIsCutOff) {
  WriteLog({{1, "TABLETOP", EncodedAt<tabletop_t>(1)}, {2, "TABLETOP", EncodedAt<tabletop_t>(2)}});
  std::filesystem::resize_file(in_, std::filesystem::file_size(in_) - 1);
  EXPECT_THAT(ReplayFault(), HasSubstr("cut off after 1 events"));
  EXPECT_THAT(utimes_, ElementsAre(1));
}

TEST_F(ReplayTest, LosesNoFrameOfADamagedLogWithoutATrace) {
  std::vector<LogEvent> events;
  for (int i = 1; i <= 4; ++i) events.push_back({i, "TABLETOP", EncodedAt<tabletop_t>(i)});
  WriteLog(events);
  std::ifstream file(in_, std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(file), {}};
  // Frames handled, and whether something was said of the log.
  const auto replay = [this](const std::string& log) -> std::pair<int, bool> {
    std::ofstream(in_, std::ios::binary | std::ios::trunc) << log;
    Shell shell({"module", "module", {}, true});
    Bus bus(&shell);
    int num_frames = 0;
    bus.Subscribe(kTabletop, [&num_frames](const tabletop_t&) { ++num_frames; });
    try {
      Replay(in_, "", &shell);
    } catch (const std::runtime_error&) {
      return {num_frames, true};
    }
    return {num_frames, shell.num_rejected() > 0};
  };
  const size_t event_bytes = whole.size() / 4;
  for (size_t size = 0; size < whole.size(); ++size) {
    const auto [num_frames, is_told] = replay(whole.substr(0, size));
    EXPECT_EQ(num_frames, static_cast<int>(size / event_bytes));
    EXPECT_EQ(is_told, size % event_bytes != 0 || size == 0) << size;
  }
  constexpr size_t kHeaderBytes = 28;
  for (size_t i = 0; i < whole.size(); ++i) {
    if (i % event_bytes >= kHeaderBytes) continue;
    std::string damaged = whole;
    damaged[i] = static_cast<char>(~damaged[i]);
    const auto [num_frames, is_told] = replay(damaged);
    EXPECT_TRUE(num_frames == 4 || is_told) << "byte " << i;
  }
}

TEST_F(ReplayTest, NamesTheChannelThatALogDoesNotHold) {
  WriteLog({{1, "OBJECTS", EncodedAt<object_list_t>(1)}});
  EXPECT_THAT(ReplayFault(), HasSubstr("there is nothing on TABLETOP"));
}

TEST_F(ReplayTest, MakesNoLogWhenThereIsNothingToRead) {
  EXPECT_THAT(ReplayFault(), HasSubstr("cannot be read"));
  EXPECT_FALSE(std::filesystem::exists(out_));
}

TEST_F(ReplayTest, RefusesASource) {
  WriteLog({{1, "TABLETOP", EncodedAt<tabletop_t>(1)}});
  bus_.Poll([] { return std::nullopt; });
  EXPECT_THROW(ReplayAnswering(), ConfigError);
}

TEST_F(ReplayTest, LetsOurOwnBugsOut) {
  WriteLog({{1, "TABLETOP", EncodedAt<tabletop_t>(1)}});
  bus_.Subscribe(kTabletop, [](const tabletop_t&) { throw std::logic_error("a bug"); });
  EXPECT_THROW(Replay(in_, out_, &shell_), std::logic_error);
}

TEST_F(ReplayTest, WritesTheSameBytesEveryTime) {
  WriteLog({{1, "TABLETOP", EncodedAt<tabletop_t>(1)}, {2, "TABLETOP", EncodedAt<tabletop_t>(2)}});
  const auto run = [this](const std::string& out) {
    Shell shell({"module", "module", {}, true});
    Bus bus(&shell);
    Publisher<tabletop_t> tabletops = bus.Advertise(kTabletop);
    bus.Subscribe(kTabletop,
                  [&tabletops](const tabletop_t& tabletop) { tabletops.Publish(tabletop); });
    Replay(in_, out, &shell);
    std::ifstream file(out, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const std::string first = run(folder_ + "first.lcmlog");
  EXPECT_FALSE(first.empty());
  EXPECT_EQ(first, run(folder_ + "second.lcmlog"));
}

}  // namespace
}  // namespace declutter::runtime
