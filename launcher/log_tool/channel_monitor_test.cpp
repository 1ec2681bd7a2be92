#include "launcher/log_tool/channel_monitor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "modules/runtime/part.h"

namespace declutter::log_tool {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

launcher::Message ObjectsAt(int64_t utime) {
  object_list_t objects = {};
  objects.utime = utime;
  return launcher::Encode(kObjects, objects);
}

TEST(ChannelMonitor, TellsRateBandwidthAndAge) {
  ChannelMonitor monitor;
  for (int i = 0; i < 60; ++i) monitor.Add({"CAMERA", runtime::Bytes(1000)}, 0.1 * i);
  const std::string counts = "CAMERA            ?                       60";
  EXPECT_THAT(monitor.Lines(5.9), Contains(HasSubstr(counts + "   10.0     10.0     1.0    0.0")));
  EXPECT_THAT(monitor.Lines(6.9), Contains(HasSubstr(counts + "    5.0      5.0     1.0    1.0")));
  EXPECT_THAT(monitor.Lines(9.9), Contains(HasSubstr(counts + "    0.0      0.0     1.0    4.0")));
}

TEST(ChannelMonitor, ShowsTheLatestMessageOfTheChosenChannel) {
  ChannelMonitor monitor;
  monitor.Choose(1);
  monitor.Add(ObjectsAt(7), 0.0);
  monitor.Add(ObjectsAt(8), 0.1);
  monitor.Add({"A", runtime::Bytes(3)}, 0.1);
  EXPECT_THAT(monitor.Lines(0.1), Contains("  utime 8"));
  monitor.Choose(-1);
  EXPECT_THAT(monitor.Lines(0.1), Contains("  of no type of this version"));
  monitor.Choose(-1);
  monitor.Choose(5);
  EXPECT_THAT(monitor.Lines(0.1), Contains("  utime 8"));
  monitor.Choose("NONE");
  EXPECT_THAT(monitor.Lines(0.1), Not(Contains("  utime 8")));
}

}  // namespace
}  // namespace declutter::log_tool
