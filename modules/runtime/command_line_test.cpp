#include "modules/runtime/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "modules/runtime/config_error.h"

namespace declutter::runtime {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

CommandLine Parse(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "bin/plane_filter");
  return ParseCommandLine(static_cast<int>(arguments.size()), arguments.data());
}

std::string Fault(const std::vector<const char*>& arguments) {
  try {
    Parse(arguments);
    return "none";
  } catch (const ConfigError& error) {
    return error.what();
  }
}

TEST(CommandLine, IsCalledLikeItsProgramUnlessNamed) {
  EXPECT_EQ(Parse({}).name, "plane_filter");
  EXPECT_EQ(Parse({"--name", "left"}).name, "left");
  EXPECT_EQ(Parse({"--name", "left"}).program, "plane_filter");
}

TEST(CommandLine, TakesValuesAfterASpaceOrAnEqualsSign) {
  const CommandLine line =
      Parse({"--config=a.textproto", "--set", "a=1", "--set=b=2", "--lossless"});
  EXPECT_EQ(line.config_file, "a.textproto");
  EXPECT_THAT(line.assignments, ElementsAre("a=1", "b=2"));
  EXPECT_TRUE(line.lossless);
}

TEST(CommandLine, RemapsChannels) {
  EXPECT_THAT(Parse({"--remap", "TABLETOP=TABLETOP_2"}).remap,
              ElementsAre(Pair("TABLETOP", "TABLETOP_2")));
}

TEST(CommandLine, RefusesWhatItDoesNotKnow) {
  EXPECT_EQ(Fault({"--confg", "x"}), "--confg: unknown option; did you mean '--config'?");
  EXPECT_EQ(Fault({"x"}), "x: unknown option");
}

TEST(CommandLine, RefusesOptionsUsedWrongly) {
  EXPECT_EQ(Fault({"--config"}), "--config: needs FILE");
  EXPECT_EQ(Fault({"--config=a", "--config=b"}), "--config: given twice");
  EXPECT_EQ(Fault({"--lossless=1"}), "--lossless: takes no value");
  EXPECT_EQ(Fault({"--help", "--describe"}), "--describe: one action at a time");
  EXPECT_THAT(Fault({"--record", "out.lcmlog"}), HasSubstr("--record: needs --replay"));
}

TEST(CommandLine, RefusesChannelsThatAreNotPlainNames) {
  EXPECT_THAT(Fault({"--remap", "TABLETOP"}), HasSubstr("CHANNEL=CHANNEL"));
  EXPECT_THAT(Fault({"--remap", "TABLETOP=.*"}), HasSubstr("CHANNEL=CHANNEL"));
  EXPECT_EQ(Fault({"--remap=A=B", "--remap=A=C"}), "--remap: A is remapped twice");
}

}  // namespace
}  // namespace declutter::runtime
