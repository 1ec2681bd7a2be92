#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "launcher/supervisor.h"
#include "launcher/supervisor_words.h"

namespace declutter::launcher {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using When = RestartRule::When;

// camera -> filter, both running since 1 s; a live graph.
Supervisor Running(When when, bool is_required = true, int max_in_a_row = 10) {
  Node camera{"camera", {"filter"}, true};
  Node filter{"filter", {}};
  camera.restart = filter.restart = {when, 0.5, 4.0, max_in_a_row};
  camera.is_required = filter.is_required = is_required;
  filter.hang_limit_s = 3.0;
  Supervisor supervisor({camera, filter}, false);
  supervisor.Handle(TimePassed{}, 0.0);
  supervisor.Handle(Ready{"filter"}, 0.5);
  supervisor.Handle(Ready{"camera"}, 1.0);
  return supervisor;
}

Exited Crash(const std::string& name) { return {name, 1, true, "signal 11"}; }

TEST(SupervisorRestartTest, RestartsAfterTheDelayAndGoesOn) {
  Supervisor supervisor = Running(When::kOnFailure);
  EXPECT_THAT(Words(supervisor.Handle(Crash("filter"), 2.0)),
              ElementsAre("say filter ended with signal 11; starts again in 0.5 s"));
  EXPECT_EQ(supervisor.state("filter"), State::kPausing);
  EXPECT_THAT(Words(supervisor.Handle(TimePassed{}, 2.4)), IsEmpty());
  EXPECT_THAT(Words(supervisor.Handle(TimePassed{}, 2.5)), ElementsAre("start filter"));
  supervisor.Handle(Ready{"filter"}, 2.6);
  EXPECT_EQ(supervisor.state("filter"), State::kRunning);
  EXPECT_EQ(supervisor.num_restarts("filter"), 1);
  EXPECT_FALSE(supervisor.is_stopping());
}

TEST(SupervisorRestartTest, WaitsTwiceAsLongForEachCrashAtOnceAndGivesUpInTheEnd) {
  Supervisor supervisor = Running(When::kOnFailure, true, 3);
  double now_s = 2.0;
  for (const double delay_s : {0.5, 1.0, 2.0}) {
    supervisor.Handle(Crash("filter"), now_s);
    EXPECT_THAT(Words(supervisor.Handle(TimePassed{}, now_s + delay_s - 0.01)), IsEmpty());
    now_s += delay_s;
    EXPECT_THAT(Words(supervisor.Handle(TimePassed{}, now_s)), ElementsAre("start filter"));
  }
  EXPECT_THAT(
      Words(supervisor.Handle(Crash("filter"), now_s)),
      ElementsAre("say filter ended with signal 11 after 3 restarts in a row", "stop camera"));
  EXPECT_EQ(supervisor.exit_code(), 1);
}

TEST(SupervisorRestartTest, NeverRestartsWhatRefusesItsConfiguration) {
  Supervisor supervisor = Running(When::kAlways);
  EXPECT_THAT(Words(supervisor.Handle(Exited{"filter", 2, false, "exit code 2"}, 2.0)),
              ElementsAre("say filter ended with exit code 2", "stop camera"));
  EXPECT_EQ(supervisor.exit_code(), 2);
}

TEST(SupervisorRestartTest, GoesOnWithoutAnOptionalProcess) {
  Supervisor supervisor = Running(When::kNever, false);
  EXPECT_THAT(Words(supervisor.Handle(Crash("filter"), 2.0)),
              ElementsAre("say filter ended with signal 11; the graph goes on without it"));
  EXPECT_EQ(supervisor.state("camera"), State::kRunning);
  supervisor.Handle(Interrupted{15}, 3.0);
  supervisor.Handle(Exited{"camera", 0}, 3.1);
  EXPECT_TRUE(supervisor.finished());
  EXPECT_EQ(supervisor.exit_code(), 0);
}

TEST(SupervisorRestartTest, StartsWhatIsUpstreamOfAnOptionalProcessThatFailed) {
  Node filter{"filter", {}};
  filter.is_required = false;
  Supervisor supervisor({{"camera", {"filter"}, true}, filter}, false);
  supervisor.Handle(TimePassed{}, 0.0);
  const auto words = Words(supervisor.Handle(Crash("filter"), 0.1));
  EXPECT_EQ(words.back(), "start camera");
}

TEST(SupervisorRestartTest, RestartsASourceThatFailsLiveButNotOneAtTheEndOfItsRecordings) {
  Supervisor live = Running(When::kOnFailure);
  EXPECT_THAT(Words(live.Handle(Exited{"camera", 1, false, "exit code 1"}, 2.0)),
              ElementsAre("say camera ended with exit code 1; starts again in 0.5 s"));

  Node reader{"reader", {}, true};
  reader.restart.when = When::kOnFailure;
  Supervisor finite({reader}, true);
  finite.Handle(TimePassed{}, 0.0);
  finite.Handle(Exited{"reader", 1, false, "exit code 1"}, 2.0);
  EXPECT_TRUE(finite.finished());
  EXPECT_EQ(finite.exit_code(), 1);
}

TEST(SupervisorRestartTest, RestartsASourceThatEndsWhenItAlwaysShall) {
  Supervisor supervisor = Running(When::kAlways);
  EXPECT_THAT(Words(supervisor.Handle(Exited{"camera", 0}, 2.0)),
              ElementsAre("say camera ended; starts again in 0.5 s"));
}

TEST(SupervisorRestartTest, KillsAndRestartsWhatHangsOnAFrame) {
  Supervisor supervisor = Running(When::kOnFailure);
  for (double t = 2.0; t < 5.5; t += 0.5) {
    EXPECT_THAT(Words(supervisor.Handle(Beat{"filter", 7, true}, t)), IsEmpty());
  }
  EXPECT_THAT(Words(supervisor.Handle(TimePassed{}, 5.1)),
              ElementsAre("say filter hangs: input waits and no frame was finished for 3 s",
                          "kill filter"));
  EXPECT_THAT(Words(supervisor.Handle(Exited{"filter", 1, true, "signal 9"}, 5.2)),
              ElementsAre("say filter was killed; starts again in 0.5 s"));
  EXPECT_THAT(Words(supervisor.Handle(TimePassed{}, 5.7)), ElementsAre("start filter"));
}

TEST(SupervisorRestartTest, KillsAndRestartsWhatFallsSilent) {
  Supervisor supervisor = Running(When::kOnFailure);
  supervisor.Handle(Beat{"filter", 7, false}, 2.0);
  EXPECT_THAT(Words(supervisor.Handle(TimePassed{}, 10.1)),
              ElementsAre("say filter hangs: no sign of life for 8 s", "kill filter"));
}

TEST(SupervisorRestartTest, FailsWhenWhatHangsMayNotRestart) {
  Supervisor supervisor = Running(When::kNever);
  EXPECT_THAT(Words(supervisor.Handle(TimePassed{}, 10.1)),
              ElementsAre("say filter hangs: no sign of life for 8 s", "stop camera"));
  EXPECT_EQ(supervisor.exit_code(), 1);
}

TEST(SupervisorRestartTest, CountsTheTimeOfAHangFromTheRestart) {
  Supervisor supervisor = Running(When::kOnFailure);
  supervisor.Handle(TimePassed{}, 10.1);
  supervisor.Handle(Exited{"filter", 1, true, "signal 9"}, 10.2);
  supervisor.Handle(TimePassed{}, 10.7);
  supervisor.Handle(Ready{"filter"}, 12.0);
  EXPECT_THAT(Words(supervisor.Handle(TimePassed{}, 19.0)), IsEmpty());
  EXPECT_EQ(supervisor.state("filter"), State::kRunning);
}

TEST(SupervisorRestartTest, RestartsWhatIsNotReadyInTime) {
  Supervisor supervisor = Running(When::kOnFailure);
  supervisor.Handle(Crash("filter"), 2.0);
  supervisor.Handle(TimePassed{}, 2.5);
  EXPECT_THAT(Words(supervisor.Handle(TimePassed{}, 22.6)),
              ElementsAre("say filter is not ready 20 s after its start", "kill filter"));
  EXPECT_THAT(Words(supervisor.Handle(Exited{"filter", 1, true, "signal 9"}, 22.7)),
              ElementsAre("say filter was killed; starts again in 1 s"));
}

TEST(SupervisorRestartTest, EndsWhatPausesWhenTheRunEnds) {
  Supervisor supervisor = Running(When::kOnFailure);
  supervisor.Handle(Crash("filter"), 2.0);
  EXPECT_THAT(Words(supervisor.Handle(Interrupted{15}, 2.1)),
              ElementsAre("say stopping on signal 15", "stop camera"));
  EXPECT_THAT(Words(supervisor.Handle(Exited{"camera", 0}, 2.6)), IsEmpty());
  EXPECT_TRUE(supervisor.finished());
}

TEST(SupervisorRestartTest, StopsAndStartsOneProcessWhenAskedAndTheRunGoesOn) {
  Supervisor supervisor = Running(When::kNever);
  EXPECT_THAT(Words(supervisor.Handle(Asked{Asked::Verb::kStop, "filter"}, 2.0)),
              ElementsAre("stop filter"));
  EXPECT_THAT(Words(supervisor.Handle(Exited{"filter", 0}, 2.1)), IsEmpty());
  EXPECT_EQ(supervisor.state("filter"), State::kStopped);
  EXPECT_THAT(Words(supervisor.Handle(TimePassed{}, 99.0)), IsEmpty());
  EXPECT_THAT(Words(supervisor.Handle(Asked{Asked::Verb::kStart, "filter"}, 100.0)),
              ElementsAre("start filter"));
  EXPECT_EQ(supervisor.exit_code(), 0);
}

TEST(SupervisorRestartTest, GoesOnWhileItsOnlySourceIsStopped) {
  Supervisor supervisor = Running(When::kNever);
  supervisor.Handle(Asked{Asked::Verb::kStop, "camera"}, 2.0);
  EXPECT_THAT(Words(supervisor.Handle(Exited{"camera", 0}, 2.1)), IsEmpty());
  EXPECT_FALSE(supervisor.is_stopping());
}

TEST(SupervisorRestartTest, KillsWhatDoesNotStopWhenAskedWithoutFailing) {
  Supervisor supervisor = Running(When::kNever);
  supervisor.Handle(Asked{Asked::Verb::kRestart, "filter"}, 2.0);
  EXPECT_THAT(
      Words(supervisor.Handle(TimePassed{}, 7.1)),
      ElementsAre("say filter still runs 5 s after it was asked to stop: killed", "kill filter"));
  EXPECT_THAT(Words(supervisor.Handle(Exited{"filter", 1, true, "signal 9"}, 7.2)),
              ElementsAre("start filter"));
  EXPECT_EQ(supervisor.exit_code(), 0);
}

TEST(SupervisorRestartTest, StartsAtOnceWhatPausesWhenAsked) {
  Supervisor supervisor = Running(When::kOnFailure);
  supervisor.Handle(Crash("filter"), 2.0);
  EXPECT_THAT(Words(supervisor.Handle(Asked{Asked::Verb::kRestart, "filter"}, 2.1)),
              ElementsAre("start filter"));
}

}  // namespace
}  // namespace declutter::launcher
