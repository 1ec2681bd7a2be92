#include "launcher/plan_replay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "modules/runtime/config_error.h"

namespace declutter::launcher {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Key;

class PlanReplayTest : public testing::Test {
 protected:
  PlanReplayTest() {
    Add("source", {}, {{"DEPTH", "depth_t"}, {"COLOR", "color_t"}});
    Add("filter", {{"DEPTH", "depth_t"}}, {{"TABLETOP", "tabletop_t"}});
    Add("segmenter", {{"TABLETOP", "tabletop_t"}}, {{"HYPOTHESES", "hypotheses_t"}});
    Add("verifier", {{"DEPTH", "depth_t"}, {"HYPOTHESES", "hypotheses_t"}},
        {{"OBJECTS", "object_list_t"}});
    Add("exporter", {{"COLOR", "color_t"}, {"OBJECTS", "object_list_t"}}, {});
    line_.replay = "run.lcm";
  }

  void Add(const std::string& name, std::vector<Port> inputs, std::vector<Port> outputs) {
    ResolvedModule module;
    module.wiring = {name, "", std::move(inputs), std::move(outputs)};
    graph_.modules.push_back(module);
  }

  ReplayPlan PlanFrom(const std::string& module) {
    line_.from = module;
    return PlanReplay(line_, &graph_);
  }

  std::vector<std::string> Started() const {
    std::vector<std::string> names;
    for (const ResolvedModule& module : graph_.modules) names.push_back(module.wiring.name);
    return names;
  }

  ResolvedGraph graph_;
  CommandLine line_;
};

TEST_F(PlanReplayTest, TakesTheLogInPlaceOfTheSources) {
  const ReplayPlan plan = PlanFrom("");
  EXPECT_THAT(Started(), ElementsAre("filter", "segmenter", "verifier", "exporter"));
  EXPECT_THAT(plan.fed, ElementsAre(Key("COLOR"), Key("DEPTH")));
  EXPECT_EQ(plan.fed.at("DEPTH"), "depth_t");
  EXPECT_THAT(plan.awaited, ElementsAre("OBJECTS"));
  EXPECT_THAT(plan.needed, ElementsAre("DEPTH"));
  EXPECT_TRUE(graph_.lossless);
}

TEST_F(PlanReplayTest, FeedsWhatNoStartedModulePublishesAndNeedsWhatResultsComeFrom) {
  const ReplayPlan plan = PlanFrom("segmenter");
  EXPECT_THAT(Started(), ElementsAre("segmenter", "verifier", "exporter"));
  EXPECT_THAT(plan.fed, ElementsAre(Key("COLOR"), Key("DEPTH"), Key("TABLETOP")));
  EXPECT_THAT(plan.needed, ElementsAre("DEPTH", "TABLETOP"));
}

TEST_F(PlanReplayTest, AwaitsTheStatusOfAModuleThatPublishesNothing) {
  const ReplayPlan plan = PlanFrom("exporter");
  EXPECT_THAT(plan.fed, ElementsAre(Key("COLOR"), Key("OBJECTS")));
  EXPECT_THAT(plan.awaited, ElementsAre("MODULE_STATUS"));
  EXPECT_THAT(plan.needed, IsEmpty());
}

TEST_F(PlanReplayTest, LeavesNothingOutAtASpeed) {
  line_.speed = 1.0;
  EXPECT_THAT(PlanFrom("segmenter").needed, IsEmpty());
  EXPECT_FALSE(graph_.lossless);
}

TEST_F(PlanReplayTest, RefusesAnUnknownModule) {
  EXPECT_THROW(PlanFrom("segmentor"), runtime::ConfigError);
}

}  // namespace
}  // namespace declutter::launcher
