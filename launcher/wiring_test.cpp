#include "launcher/wiring.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace declutter::launcher {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const Port kDepth{"DEPTH_FRAME", "depth_frame_t"};
const Port kTable{"TABLETOP", "tabletop_t"};
const Port kObjectList{"OBJECTS", "object_list_t"};

std::vector<std::string> Texts(const std::vector<Fault>& faults) {
  std::vector<std::string> texts;
  for (const Fault& fault : faults) texts.push_back(fault.where + ": " + fault.what);
  return texts;
}

TEST(WiringTest, AcceptsASourceThatIsReleasedByTheObjectsOfItsFrame) {
  const std::vector<WiredModule> modules = {{"source", "g:1:1", {kObjectList}, {kDepth}},
                                            {"verifier", "g:2:1", {kDepth}, {kObjectList}}};
  EXPECT_THAT(CheckWiring(modules), IsEmpty());
  EXPECT_TRUE(IsSource(modules[0]));
  EXPECT_FALSE(IsSource(modules[1]));
  EXPECT_THAT(Downstream(modules, 0), ElementsAre(1));
  EXPECT_THAT(Downstream(modules, 1), IsEmpty());
}

TEST(WiringTest, FindsASecondPublisher) {
  EXPECT_THAT(Texts(CheckWiring({{"one", "g:1:1", {}, {kDepth}}, {"two", "g:2:1", {}, {kDepth}}})),
              ElementsAre("g:2:1: two publishes DEPTH_FRAME, as one does"));
}

TEST(WiringTest, LetsAllModulesPublishTheirStatus) {
  const Port status{"MODULE_STATUS", "module_status_t"};
  EXPECT_THAT(CheckWiring({{"one", "g:1:1", {}, {kDepth, status}},
                           {"two", "g:2:1", {kDepth}, {status}},
                           {"viewer", "g:3:1", {status}, {}}}),
              IsEmpty());
}

TEST(WiringTest, FindsAChannelThatNothingPublishesAndTheNameMeant) {
  EXPECT_THAT(Texts(CheckWiring({{"source", "g:1:1", {}, {{"DEPTH_FRAMES", "depth_frame_t"}}},
                                 {"filter", "g:2:1", {kDepth}, {}}})),
              ElementsAre("g:2:1: filter consumes DEPTH_FRAME, which nothing publishes; did you "
                          "mean 'DEPTH_FRAMES'?"));
}

TEST(WiringTest, AcceptsAChannelThatComesFromOutside) {
  const std::vector<WiredModule> modules = {{"filter", "g:2:1", {kDepth}, {kTable}}};
  EXPECT_THAT(Unpublished(modules), ElementsAre("DEPTH_FRAME"));
  EXPECT_THAT(CheckWiring(modules, {"DEPTH_FRAME"}), IsEmpty());
  EXPECT_THAT(CheckWiring(modules, {"TABLETOP"}), testing::SizeIs(1));
}

TEST(WiringTest, FindsAChannelWithTwoTypes) {
  EXPECT_THAT(Texts(CheckWiring({{"source", "g:1:1", {}, {{"TABLETOP", "depth_frame_t"}}},
                                 {"estimator", "g:2:1", {kTable}, {}}})),
              ElementsAre("g:2:1: estimator consumes tabletop_t on TABLETOP, where source "
                          "publishes depth_frame_t"));
}

TEST(WiringTest, StartsAModuleAfterThoseThatItSendsToAndThoseThatTheGraphNames) {
  const std::vector<WiredModule> modules = {{"source", "g:1:1", {}, {kDepth}},
                                            {"filter", "g:2:1", {kDepth}, {}, {"viewer"}},
                                            {"viewer", "g:3:1", {kDepth}, {}}};
  EXPECT_THAT(CheckWiring(modules), IsEmpty());
  EXPECT_THAT(Predecessors(modules, 0), ElementsAre(1, 2));
  EXPECT_THAT(Predecessors(modules, 1), ElementsAre(2));
  EXPECT_THAT(Downstream(modules, 1), IsEmpty());
}

TEST(WiringTest, FindsACycleOfModulesThatWaitForEachOther) {
  EXPECT_THAT(Texts(CheckWiring({{"source", "g:1:1", {}, {kDepth}},
                                 {"filter", "g:2:1", {kDepth}, {}, {"source"}}})),
              ElementsAre("g:1:1: a cycle: source -> filter -> source"));
}

TEST(WiringTest, FindsACycle) {
  const Port there{"THERE", "tabletop_t"}, back{"BACK", "tabletop_t"};
  EXPECT_THAT(Texts(CheckWiring({{"source", "g:1:1", {}, {kDepth}},
                                 {"ping", "g:2:1", {kDepth, back}, {there}},
                                 {"pong", "g:3:1", {there}, {back}}})),
              ElementsAre("g:2:1: a cycle: ping -> pong -> ping"));
}

}  // namespace
}  // namespace declutter::launcher
