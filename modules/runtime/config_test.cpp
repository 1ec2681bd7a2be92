#include "modules/runtime/config.h"

#include <gmock/gmock.h>
#include <google/protobuf/dynamic_message.h>
#include <gtest/gtest.h>

#include "modules/runtime/example_config.pb.h"
#include "modules/runtime/reference.h"

namespace declutter::runtime {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string ParseFault(const std::string& text, google::protobuf::Message* config) {
  try {
    ParseConfig(text, "good.textproto", config);
    return "none";
  } catch (const ConfigFileError& error) {
    return error.what();
  }
}

std::string ParseFault(const std::string& text) {
  ExampleConfig config;
  return ParseFault(text, &config);
}

std::string SetFault(const std::string& assignment) {
  ExampleConfig config;
  try {
    SetField(assignment, &config);
    return "none";
  } catch (const ConfigError& error) {
    return error.what();
  }
}

TEST(ParseConfig, ReadsWhatIsAllowed) {
  ExampleConfig config;
  EXPECT_EQ(ParseFault("distance_threshold_m: 0.1\ncamera { height_m: 1.5 }", &config), "none");
  EXPECT_EQ(config.distance_threshold_m(), 0.1);
  EXPECT_EQ(config.camera().height_m(), 1.5);
}

TEST(ParseConfig, PointsAtASyntaxError) {
  EXPECT_EQ(ParseFault("mode: \"paper\"\nnum_iterations: many\n"),
            "good.textproto:2:17: Expected integer, got: many");
}

TEST(ParseConfig, PointsAtAMisspeltFieldAndSuggestsTheRightOne) {
  EXPECT_EQ(ParseFault("mode: \"paper\"\n  num_iteration: 3\n"),
            "good.textproto:2:3: no field named 'num_iteration' in declutter.ExampleConfig; "
            "did you mean 'num_iterations'?");
  EXPECT_EQ(ParseFault("camera { hight_m: 1 }"),
            "good.textproto:1:10: no field named 'hight_m' in declutter.ExampleConfig.Camera; "
            "did you mean 'height_m'?");
}

TEST(ParseConfig, PointsAtEveryValueOutsideItsRange) {
  EXPECT_EQ(ParseFault("distance_threshold_m: 0.5\n\n num_iterations: 0"),
            "good.textproto:1:1: distance_threshold_m = 0.5 outside [0.001, 0.1] m\n"
            "good.textproto:3:2: num_iterations = 0 outside [1, inf)");
}

TEST(ParseConfig, ChecksNestedAndRepeatedFields) {
  EXPECT_EQ(ParseFault("camera {\n  height_m: 9\n}"),
            "good.textproto:2:3: camera.height_m = 9 outside [0.1, 3] m");
  EXPECT_THAT(ParseFault("sizes_px: 5\nsizes_px: 101"),
              HasSubstr("good.textproto:2:1: sizes_px = 101 outside (-inf, 100] px"));
}

TEST(ParseConfig, RefusesWhatIsNotFinite) {
  EXPECT_EQ(ParseFault("distance_threshold_m: nan"),
            "good.textproto:1:1: distance_threshold_m = nan is not a number");
  EXPECT_EQ(ParseFault("weight: nan"), "good.textproto:1:1: weight = nan is not a number");
  EXPECT_EQ(ParseFault("weight: -inf"), "good.textproto:1:1: weight = -inf is not finite");
}

TEST(ParseConfig, RefusesAWordThatIsNotAllowed) {
  EXPECT_EQ(ParseFault("mode: \"papr\""),
            "good.textproto:1:1: mode = \"papr\" is not one of \"default\", \"paper\"; "
            "did you mean 'paper'?");
}

TEST(SetField, SetsEveryKindOfField) {
  ExampleConfig config;
  SetField("distance_threshold_m=0.02", &config);
  SetField("mode=paper", &config);
  SetField("input=/some where/x=y", &config);
  SetField("camera.height_m=2", &config);
  SetField("is_fast=true", &config);
  SetField("sizes_px=3", &config);
  SetField("sizes_px=4", &config);
  EXPECT_EQ(config.distance_threshold_m(), 0.02);
  EXPECT_EQ(config.mode(), "paper");
  EXPECT_EQ(config.input(), "/some where/x=y");
  EXPECT_EQ(config.camera().height_m(), 2);
  EXPECT_TRUE(config.is_fast());
  EXPECT_THAT(config.sizes_px(), ElementsAre(3, 4));
}

TEST(SetField, ReplacesWhatWasSetBefore) {
  ExampleConfig config;
  SetField("num_iterations=3", &config);
  SetField("num_iterations=4", &config);
  EXPECT_EQ(config.num_iterations(), 4);
}

TEST(SetField, RefusesWhatCannotBeSet) {
  EXPECT_THAT(SetFault("num_iteration=3"), HasSubstr("did you mean 'num_iterations'?"));
  EXPECT_THAT(SetFault("camera.hight_m=3"), HasSubstr("did you mean 'height_m'?"));
  EXPECT_THAT(SetFault("num_iterations=many"), HasSubstr("Expected integer"));
  EXPECT_THAT(SetFault("num_iterations=3 4"), HasSubstr("--set num_iterations=3 4: "));
  EXPECT_THAT(SetFault("num_iterations"), HasSubstr("field=value"));
  EXPECT_THAT(SetFault("camera=3"), HasSubstr("cannot be set whole"));
  EXPECT_THAT(SetFault("mode.x=3"), HasSubstr("'mode' has no fields"));
}

TEST(SetField, ChecksRanges) {
  EXPECT_EQ(SetFault("distance_threshold_m=7"),
            "--set distance_threshold_m=7: distance_threshold_m = 7 outside [0.001, 0.1] m");
}

TEST(CheckComplete, NamesWhatMustBeSet) {
  ExampleConfig config;
  EXPECT_THROW(CheckComplete(config), ConfigError);
  config.set_input("");
  EXPECT_THROW(CheckComplete(config), ConfigError);
  config.set_input("scenes");
  EXPECT_NO_THROW(CheckComplete(config));
}

TEST(ParseConfig, ChecksTheConfigurationOfAProgramThatIsOnlyDescribed) {
  const Shell shell({"example", "example", {}, false});
  const ModuleDescription description = Describe(shell, *ExampleConfig::descriptor());
  google::protobuf::DescriptorPool pool;
  for (const auto& file : description.config_files().file()) {
    ASSERT_NE(pool.BuildFile(file), nullptr) << file.name();
  }
  google::protobuf::DynamicMessageFactory factory(&pool);
  const auto* type = pool.FindMessageTypeByName(description.config_type());
  ASSERT_NE(type, nullptr);
  const std::unique_ptr<google::protobuf::Message> config(factory.GetPrototype(type)->New());
  EXPECT_EQ(ParseFault("camera { height_m: 9 }", config.get()),
            "good.textproto:1:10: camera.height_m = 9 outside [0.1, 3] m");
}

}  // namespace
}  // namespace declutter::runtime
