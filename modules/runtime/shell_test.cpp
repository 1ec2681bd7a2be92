#include "modules/runtime/shell.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "modules/runtime/bus.h"
#include "modules/runtime/config_error.h"

namespace declutter::runtime {
namespace {

using testing::ElementsAre;

void Send(std::int64_t utime, Shell* shell) {
  object_list_t message{};
  message.utime = utime;
  Bytes bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  shell->Receive("OBJECTS", bytes.data(), bytes.size());
}

module_status_t StatusOf(Shell* shell) {
  module_status_t status{};
  shell->Connect([&status](const std::string&, const Bytes& bytes) {
    status.decode(bytes.data(), 0, static_cast<int>(bytes.size()));
  });
  shell->PublishStatus(Shell::State::kRunning);
  return status;
}

TEST(Shell, HandlesMessagesBetweenThePollsOfASource) {
  Shell shell({"source", "source", {}, true});
  Bus bus(&shell);
  std::vector<std::string> calls;
  bus.OnStart([&calls] { calls.push_back("start"); });
  bus.Subscribe(kObjects, [&calls](const object_list_t& objects) {
    calls.push_back("objects " + std::to_string(objects.utime));
  });
  bus.Poll([&]() -> std::optional<double> {
    calls.push_back("poll");
    if (calls.size() > 5) return std::nullopt;
    Send(static_cast<std::int64_t>(calls.size()), &shell);
    return 0;
  });
  shell.Start();
  shell.Work();
  EXPECT_THAT(calls, ElementsAre("start", "poll", "objects 2", "poll", "objects 4", "poll"));
}

TEST(Shell, CountsSkippedFramesAtTheSensorsRate) {
  Shell shell({"exporter", "exporter", {}, false});
  Bus bus(&shell);
  std::vector<std::int64_t> utimes;
  bus.Subscribe(kObjects,
                [&utimes](const object_list_t& objects) { utimes.push_back(objects.utime); });
  for (int i = 1; i <= 3; ++i) Send(i, &shell);
  shell.HandleWaiting();
  EXPECT_THAT(utimes, ElementsAre(3));
  const module_status_t status = StatusOf(&shell);
  EXPECT_EQ(status.num_in, 1);
  EXPECT_EQ(status.num_skipped, 2);
  EXPECT_EQ(status.last_utime, 3);
}

TEST(Shell, HandlesAllThatWaitsBeforeALosslessRunEnds) {
  Shell shell({"exporter", "exporter", {}, true});
  Bus bus(&shell);
  std::vector<std::int64_t> utimes;
  bus.Subscribe(kObjects,
                [&utimes](const object_list_t& objects) { utimes.push_back(objects.utime); });
  for (int i = 1; i <= 3; ++i) Send(i, &shell);
  shell.Stop();
  shell.Work();
  EXPECT_THAT(utimes, ElementsAre(1, 2, 3));
}

TEST(Shell, ReportsWhoItIsAndWhatIsWrong) {
  Shell shell({"left", "exporter", {}, false});
  shell.Fail("disk full");
  const module_status_t status = StatusOf(&shell);
  EXPECT_EQ(status.module, "left");
  EXPECT_EQ(status.program, "exporter");
  EXPECT_EQ(status.state, 1);
  EXPECT_EQ(status.message, "disk full");
  EXPECT_TRUE(shell.failed());
  EXPECT_EQ(StatusOf(&shell).message, "");
}

TEST(Shell, DoesNotSendMessagesThatTheNetworkWouldLose) {
  Shell shell({"source", "source", {}, false});
  Bus bus(&shell);
  std::vector<std::size_t> sizes;
  shell.Connect(
      [&sizes](const std::string&, const Bytes& bytes) { sizes.push_back(bytes.size()); });
  const Publisher<color_frame_t> colors = bus.Advertise(kColorFrame);
  color_frame_t color{};
  color.num_bytes = 190'000;
  color.jpeg.resize(190'000);
  colors.Publish(color);
  color.num_bytes = 210'000;
  color.jpeg.resize(210'000);
  colors.Publish(color);
  EXPECT_EQ(sizes.size(), 1u);
  EXPECT_EQ(shell.num_rejected(), 1);
}

TEST(Shell, UsesRemappedChannels) {
  Shell shell({"exporter", "exporter", {{"OBJECTS", "OBJECTS_2"}}, false});
  Bus bus(&shell);
  int num_handled = 0;
  bus.Subscribe(kObjects, [&num_handled](const object_list_t&) { ++num_handled; });
  Send(1, &shell);
  shell.HandleWaiting();
  EXPECT_EQ(num_handled, 0);
  EXPECT_EQ(shell.inputs()[0].channel, "OBJECTS_2");
}

TEST(Shell, LetsAnUnusableConfigurationOut) {
  Shell shell({"exporter", "exporter", {}, false});
  Bus bus(&shell);
  bus.Subscribe(kObjects, [](const object_list_t&) { throw ConfigError("output: not a folder"); });
  Send(1, &shell);
  EXPECT_THROW(shell.HandleWaiting(), ConfigError);
}

}  // namespace
}  // namespace declutter::runtime
