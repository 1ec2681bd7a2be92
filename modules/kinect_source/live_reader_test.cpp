#include "modules/kinect_source/live_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>
#include <memory>
#include <vector>

namespace declutter {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// A sensor and its room, as a test wants them. Time passes only while a frame is waited for.
struct World {
  int64_t now_us = 1'700'000'000'000'000;
  bool can_open = true;
  bool is_connected = true;
  std::deque<SensorFrame> frames;  // what the sensor sends next
  bool is_damaged = false;
  int num_opened = 0;

  std::string failure;  // what the sensor tells next

  std::vector<std::string> troubles, rejected, failed, notes;
  int64_t num_skipped = 0;
};

class FakeSensor : public Sensor {
 public:
  explicit FakeSensor(World* world) : world_(world) {}

  std::optional<SensorFrame> Read(double timeout_s) override {
    world_->now_us += std::llround(1e6 * timeout_s);
    if (std::exchange(world_->is_damaged, false)) throw DamagedFrame("half a frame");
    if (world_->frames.empty()) return std::nullopt;
    const SensorFrame frame = world_->frames.front();
    world_->frames.pop_front();
    return frame;
  }
  bool is_connected() const override { return world_->is_connected; }
  std::string TakeFailure() override { return std::exchange(world_->failure, ""); }
  std::string description() const override { return "fake"; }

 private:
  World* world_;
};

SensorFrame Frame(int64_t index, uint16_t count = 700) {
  SensorFrame frame;
  frame.device_us = index * 33'333;
  frame.index = index;
  frame.depth.camera = {1, 1, 500, 500, 0, 0};
  frame.depth.counts = {count};
  return frame;
}

class LiveReaderTest : public testing::Test {
 protected:
  std::unique_ptr<LiveReader> Reader(int warm_up_frames = 0) {
    KinectSourceConfig config;
    config.set_warm_up_frames(warm_up_frames);
    const auto open = [this]() -> std::unique_ptr<Sensor> {
      if (!world_.can_open) throw NoSensor("no device");
      ++world_.num_opened;
      return std::make_unique<FakeSensor>(&world_);
    };
    const SensorEvents events{[this](const std::string& text) { world_.troubles.push_back(text); },
                              [this](int64_t num_frames) { world_.num_skipped += num_frames; },
                              [this](const std::string& why) { world_.rejected.push_back(why); },
                              [this](const std::string& text) { world_.failed.push_back(text); },
                              [this](const std::string& text) { world_.notes.push_back(text); }};
    return std::make_unique<LiveReader>(
        config, open, [this] { return world_.now_us; }, events);
  }

  // Reads until there is no frame for a while.
  std::vector<std::string> ReadFor(LiveReader* reader, double duration_s) {
    std::vector<std::string> names;
    const int64_t end_us = world_.now_us + std::llround(1e6 * duration_s);
    while (world_.now_us < end_us) {
      const ReadResult result = reader->Read();
      world_.now_us += std::llround(1e6 * result.wait_s);
      if (result.frame) names.push_back(result.frame->depth.header.frame);
    }
    return names;
  }

  World world_;
};

TEST_F(LiveReaderTest, NamesFramesByTheirNumber) {
  const auto reader = Reader();
  world_.frames = {Frame(7), Frame(8)};
  EXPECT_THAT(ReadFor(reader.get(), 0.1), ElementsAre("000000", "000001"));
  EXPECT_EQ(world_.num_skipped, 0);
}

TEST_F(LiveReaderTest, RefusesToBeginWithoutASensor) {
  world_.can_open = false;
  EXPECT_THROW(Reader(), NoSensor);
}

TEST_F(LiveReaderTest, LeavesOutFramesWhileTheSensorWarmsUp) {
  const auto reader = Reader(2);
  world_.frames = {Frame(1), Frame(2), Frame(3)};
  EXPECT_THAT(ReadFor(reader.get(), 0.1), ElementsAre("000000"));
}

TEST_F(LiveReaderTest, CountsFramesThatWereNotRead) {
  const auto reader = Reader();
  world_.frames = {Frame(1), Frame(2), Frame(6)};
  ReadFor(reader.get(), 0.1);
  EXPECT_EQ(world_.num_skipped, 3);
}

TEST_F(LiveReaderTest, RejectsADamagedFrameAndGoesOn) {
  const auto reader = Reader();
  world_.is_damaged = true;
  world_.frames = {Frame(1)};
  EXPECT_EQ(ReadFor(reader.get(), 0.1).size(), 1u);
  EXPECT_THAT(world_.rejected, ElementsAre("half a frame"));
  EXPECT_EQ(world_.num_opened, 1);
}

TEST_F(LiveReaderTest, ReportsAnUnpluggedSensorAndOpensItWhenItIsBack) {
  const auto reader = Reader();
  world_.frames = {Frame(50)};
  ReadFor(reader.get(), 0.1);
  world_.is_connected = world_.can_open = false;
  ReadFor(reader.get(), 3);
  EXPECT_THAT(world_.troubles, ElementsAre("no sensor: unplugged", "no sensor: no device"));
  world_.is_connected = world_.can_open = true;
  world_.frames = {Frame(1)};
  EXPECT_THAT(ReadFor(reader.get(), 1), ElementsAre("000001"));
  EXPECT_EQ(world_.troubles.back(), "");
  EXPECT_EQ(world_.num_skipped, 0);
}

TEST_F(LiveReaderTest, TimeGoesOnWhenTheSensorIsBack) {
  const auto reader = Reader();
  world_.frames = {Frame(5'000'000)};
  const int64_t before = reader->Read().frame->depth.header.utime;
  world_.is_connected = false;
  ReadFor(reader.get(), 1);
  world_.is_connected = true;
  world_.frames = {Frame(1)};
  ReadResult result;
  while (!result.frame) result = reader->Read();
  EXPECT_GT(result.frame->depth.header.utime, before + 1'000'000);
  EXPECT_LE(result.frame->depth.header.utime, world_.now_us);
}

TEST_F(LiveReaderTest, OpensASensorAgainThatStopsSending) {
  const auto reader = Reader();
  world_.frames = {Frame(1)};
  ReadFor(reader.get(), 0.5);
  EXPECT_EQ(world_.num_opened, 1);
  ReadFor(reader.get(), 1);
  EXPECT_EQ(world_.num_opened, 2);
  EXPECT_THAT(world_.troubles, ElementsAre("no sensor: it sends no frames"));
}

TEST_F(LiveReaderTest, GivesASensorTimeToStart) {
  const auto reader = Reader();
  ReadFor(reader.get(), 4);
  EXPECT_EQ(world_.num_opened, 1);
  ReadFor(reader.get(), 2);
  EXPECT_EQ(world_.num_opened, 2);
}

TEST_F(LiveReaderTest, SaysWhenTheSensorMeasuresNothing) {
  const auto reader = Reader();
  for (int i = 1; i <= 80; ++i) world_.frames.push_back(Frame(i, 0));
  EXPECT_EQ(ReadFor(reader.get(), 1.6).size(), 80u);
  ASSERT_EQ(world_.troubles.size(), 1u);
  EXPECT_THAT(world_.troubles[0], HasSubstr("measures nothing"));
  world_.frames = {Frame(81)};
  ReadFor(reader.get(), 0.1);
  EXPECT_EQ(world_.troubles.back(), "");
}

TEST_F(LiveReaderTest, PassesOnWhatHasFailedAndGoesOn) {
  const auto reader = Reader();
  world_.failure = "disk full";
  world_.frames = {Frame(1)};
  EXPECT_EQ(ReadFor(reader.get(), 0.1).size(), 1u);
  EXPECT_THAT(world_.failed, ElementsAre("disk full"));
}

TEST_F(LiveReaderTest, NotesItsFiguresAtTheEnd) {
  {
    const auto reader = Reader();
    world_.frames = {Frame(1), Frame(3)};
    ReadFor(reader.get(), 0.1);
  }
  EXPECT_THAT(world_.notes.back(), HasSubstr("2 frames read, 1 skipped, arrival jitter"));
}

}  // namespace
}  // namespace declutter
