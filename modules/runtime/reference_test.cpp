#include "modules/runtime/reference.h"

#include <gmock/gmock.h>
#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include "modules/runtime/bus.h"
#include "modules/runtime/config.h"
#include "modules/runtime/example_config.pb.h"

namespace declutter::runtime {
namespace {

using testing::HasSubstr;

TEST(ConfigText, ShowsDefaultsToo) {
  ExampleConfig config;
  config.set_num_iterations(7);
  const std::string text = ConfigText(config);
  EXPECT_THAT(text, HasSubstr("num_iterations: 7"));
  EXPECT_THAT(text, HasSubstr("distance_threshold_m: 0.01"));
  EXPECT_THAT(text, HasSubstr("height_m: 0.9"));
}

TEST(ConfigText, CanBeReadBack) {
  const std::string text = ConfigText(ExampleConfig());
  ExampleConfig read;
  ParseConfig(text, "printed.textproto", &read);
  EXPECT_EQ(ConfigText(read), text);
}

TEST(Describe, NamesChannelsOnTheWireAndTheConfig) {
  Shell shell({"example", "example", {{"TABLETOP", "TABLETOP_2"}}, false});
  Bus bus(&shell);
  bus.SubscribeJoined(kDepthFrame, kTabletop, [](const depth_frame_t&, const tabletop_t&) {});
  bus.Advertise(kFeatures);
  const ModuleDescription description = Describe(shell, *ExampleConfig::descriptor());
  ASSERT_EQ(description.input_size(), 2);
  EXPECT_EQ(description.input(0).channel(), "DEPTH_FRAME");
  EXPECT_EQ(description.input(1).channel(), "TABLETOP_2");
  EXPECT_EQ(description.input(1).type(), "tabletop_t");
  ASSERT_EQ(description.output_size(), 1);
  EXPECT_EQ(description.output(0).channel(), "FEATURES");
  EXPECT_EQ(description.config_type(), "declutter.ExampleConfig");
}

TEST(Help, TellsTypeDefaultRangeAndMeaning) {
  const Shell shell({"example", "example", {}, false});
  const ExampleConfig defaults;
  const std::string help = Help(Describe(shell, *ExampleConfig::descriptor()), defaults);
  EXPECT_THAT(help, HasSubstr("distance_threshold_m  (double, default 0.01, in [0.001, 0.1] m)\n"
                              "      inliers are closer to the plane\n"));
  EXPECT_THAT(help, HasSubstr("camera.height_m  (double, default 0.9, in [0.1, 3] m)"));
  EXPECT_THAT(help,
              HasSubstr("mode  (string, default \"default\", one of \"default\", \"paper\")"));
  EXPECT_THAT(help, HasSubstr("input  (string, default \"\", must be set)"));
  EXPECT_THAT(help, HasSubstr("--print_config"));
}

}  // namespace
}  // namespace declutter::runtime
