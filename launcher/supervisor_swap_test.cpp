#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "launcher/supervisor.h"
#include "launcher/supervisor_words.h"

namespace declutter::launcher {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// camera -> filter, of which the filter is to be swapped since 2 s; a live graph.
Supervisor Swapping() {
  Supervisor supervisor({{"camera", {"filter"}, true}, {"filter", {}}}, false);
  supervisor.Handle(TimePassed{}, 0.0);
  supervisor.Handle(Ready{"filter"}, 0.5);
  supervisor.Handle(Ready{"camera"}, 1.0);
  EXPECT_THAT(Words(supervisor.Handle(Asked{Asked::Verb::kSwap, "filter"}, 2.0)),
              ElementsAre("prepare filter"));
  return supervisor;
}

TEST(SupervisorSwapTest, EndsTheOldWhenTheNewHasAWholeFrameAndPromotesItThen) {
  Supervisor supervisor = Swapping();
  EXPECT_THAT(Words(supervisor.Handle(SuccessorBeat{"filter", false}, 3.0)), IsEmpty());
  EXPECT_THAT(Words(supervisor.Handle(SuccessorBeat{"filter", true}, 4.0)),
              ElementsAre("stop filter"));
  EXPECT_THAT(Words(supervisor.Handle(Exited{"filter", 0}, 4.1)), ElementsAre("promote filter"));
  EXPECT_EQ(supervisor.state("filter"), State::kRunning);
  EXPECT_THAT(Words(supervisor.Handle(Beat{"filter", 0, true}, 4.2)), IsEmpty());
  EXPECT_TRUE(supervisor.is_swapping("filter"));
  EXPECT_THAT(Words(supervisor.Handle(Beat{"filter", 1, true}, 4.3)), ElementsAre("adopt filter"));
  EXPECT_EQ(supervisor.num_swaps("filter"), 1);
  EXPECT_EQ(supervisor.num_restarts("filter"), 0);
  EXPECT_FALSE(supervisor.is_swapping("filter"));
}

// camera -> filter, where another filter has taken over at 4 s.
Supervisor OnTrial() {
  Supervisor supervisor = Swapping();
  supervisor.Handle(SuccessorBeat{"filter", true}, 3.0);
  EXPECT_THAT(Words(supervisor.Handle(Exited{"filter", 0}, 4.0)), ElementsAre("promote filter"));
  return supervisor;
}

TEST(SupervisorSwapTest, StartsTheOldAgainWhenTheNewEndsBeforeItsFirstFrame) {
  Supervisor supervisor = OnTrial();
  EXPECT_THAT(Words(supervisor.Handle(Exited{"filter", 2, false, "exit code 2"}, 4.5)),
              ElementsAre("say the successor of filter ended with exit code 2 before its first "
                          "frame; filter starts again as it was",
                          "revert filter", "start filter"));
  EXPECT_EQ(supervisor.num_swaps("filter"), 0);
  EXPECT_FALSE(supervisor.is_swapping("filter"));
  EXPECT_EQ(supervisor.exit_code(), 0);
}

TEST(SupervisorSwapTest, TakesTheNewForGoodWhereNoFrameComes) {
  Supervisor supervisor = OnTrial();
  EXPECT_THAT(Words(supervisor.Handle(TimePassed{}, 7.1)), ElementsAre("adopt filter"));
  EXPECT_EQ(supervisor.num_swaps("filter"), 1);
  supervisor.Handle(Exited{"filter", 1, true, "signal 11"}, 7.2);
  EXPECT_EQ(supervisor.exit_code(), 1);
}

TEST(SupervisorSwapTest, TakesTheNewForGoodWhenAUserOrTheEndOfTheRunStopsIt) {
  Supervisor stopped = OnTrial();
  EXPECT_THAT(Words(stopped.Handle(Asked{Asked::Verb::kStop, "filter"}, 4.5)),
              ElementsAre("adopt filter", "stop filter"));
  Supervisor ended = OnTrial();
  EXPECT_EQ(Words(ended.Handle(Interrupted{15}, 4.5)).at(1), "adopt filter");
}

TEST(SupervisorSwapTest, WaitsForNoFrameForEverWhereNoneComes) {
  Supervisor supervisor = Swapping();
  supervisor.Handle(SuccessorBeat{"filter", false}, 3.0);
  EXPECT_THAT(Words(supervisor.Handle(TimePassed{}, 6.0)), IsEmpty());
  EXPECT_THAT(Words(supervisor.Handle(TimePassed{}, 6.1)), ElementsAre("stop filter"));
}

TEST(SupervisorSwapTest, KeepsTheOldWhenTheNewIsNotReadyInTime) {
  Supervisor supervisor = Swapping();
  EXPECT_THAT(Words(supervisor.Handle(TimePassed{}, 22.1)),
              ElementsAre("say the successor of filter is not ready 20 s after its start; "
                          "filter goes on",
                          "drop filter"));
  EXPECT_EQ(supervisor.state("filter"), State::kRunning);
  EXPECT_FALSE(supervisor.is_swapping("filter"));
}

TEST(SupervisorSwapTest, KeepsTheOldWhenTheNewEnds) {
  Supervisor supervisor = Swapping();
  EXPECT_THAT(Words(supervisor.Handle(SuccessorExited{"filter", "exit code 2"}, 2.5)),
              ElementsAre("say the successor of filter ended with exit code 2; filter goes on"));
  EXPECT_EQ(supervisor.state("filter"), State::kRunning);
}

TEST(SupervisorSwapTest, StartsTheOldAgainWhenTheNewEndsAtTheLastMoment) {
  Supervisor supervisor = Swapping();
  supervisor.Handle(SuccessorBeat{"filter", true}, 3.0);
  EXPECT_THAT(Words(supervisor.Handle(SuccessorExited{"filter", "signal 11"}, 3.1)),
              ElementsAre("say the successor of filter ended with signal 11; filter starts again"));
  EXPECT_THAT(Words(supervisor.Handle(Exited{"filter", 0}, 3.2)), ElementsAre("start filter"));
  EXPECT_EQ(supervisor.num_swaps("filter"), 0);
}

TEST(SupervisorSwapTest, DropsTheNewWhenTheOldCrashes) {
  Supervisor supervisor = Swapping();
  EXPECT_THAT(Words(supervisor.Handle(Exited{"filter", 1, true, "signal 11"}, 2.5)),
              ElementsAre("drop filter", "say filter ended with signal 11", "stop camera"));
}

TEST(SupervisorSwapTest, DropsTheNewWhenTheRunEnds) {
  Supervisor supervisor = Swapping();
  EXPECT_THAT(Words(supervisor.Handle(Interrupted{15}, 2.5)),
              ElementsAre("say stopping on signal 15", "drop filter", "stop camera"));
}

TEST(SupervisorSwapTest, KillsAnOldThatDoesNotEnd) {
  Supervisor supervisor = Swapping();
  supervisor.Handle(SuccessorBeat{"filter", true}, 3.0);
  EXPECT_EQ(Words(supervisor.Handle(TimePassed{}, 8.1)).back(), "kill filter");
  EXPECT_THAT(Words(supervisor.Handle(Exited{"filter", 1, true, "signal 9"}, 8.2)),
              ElementsAre("promote filter"));
  EXPECT_EQ(supervisor.exit_code(), 0);
}

TEST(SupervisorSwapTest, SwapsOnlyWhatRuns) {
  Supervisor supervisor = Swapping();
  supervisor.Handle(Asked{Asked::Verb::kStop, "camera"}, 2.1);
  EXPECT_THAT(Words(supervisor.Handle(Asked{Asked::Verb::kSwap, "camera"}, 2.2)), IsEmpty());
}

}  // namespace
}  // namespace declutter::launcher
