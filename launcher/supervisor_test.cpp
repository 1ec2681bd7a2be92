#include "launcher/supervisor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "launcher/supervisor_words.h"

namespace declutter::launcher {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// source -> filter -> exporter, and a recorder downstream of all.
std::vector<Node> Chain() {
  return {{"recorder", {}},
          {"source", {"filter", "recorder"}, true},
          {"filter", {"exporter", "recorder"}},
          {"exporter", {"recorder"}}};
}

Supervisor RunningChain(bool is_finite = true) {
  Supervisor supervisor(Chain(), is_finite);
  supervisor.Handle(TimePassed{}, 0.0);
  for (const char* name : {"recorder", "exporter", "filter", "source"}) {
    supervisor.Handle(Ready{name}, 1.0);
  }
  return supervisor;
}

TEST(SupervisorTest, StartsEachNodeWhenAllItsConsumersAreReady) {
  Supervisor supervisor(Chain(), true);
  EXPECT_THAT(Words(supervisor.Handle(TimePassed{}, 0.0)), ElementsAre("start recorder"));
  EXPECT_THAT(Words(supervisor.Handle(TimePassed{}, 0.1)), IsEmpty());
  EXPECT_THAT(Words(supervisor.Handle(Ready{"recorder"}, 0.2)), ElementsAre("start exporter"));
  EXPECT_THAT(Words(supervisor.Handle(Ready{"exporter"}, 0.3)), ElementsAre("start filter"));
  EXPECT_THAT(Words(supervisor.Handle(Ready{"filter"}, 0.4)), ElementsAre("start source"));
}

TEST(SupervisorTest, DrainsFromUpstreamToDownstreamWhenTheSourceHasEnded) {
  Supervisor supervisor = RunningChain();
  EXPECT_THAT(Words(supervisor.Handle(Exited{"source", 0}, 2.0)), ElementsAre("stop filter"));
  EXPECT_THAT(Words(supervisor.Handle(Exited{"filter", 0}, 2.1)), ElementsAre("stop exporter"));
  EXPECT_THAT(Words(supervisor.Handle(Exited{"exporter", 0}, 2.2)), ElementsAre("stop recorder"));
  EXPECT_FALSE(supervisor.finished());
  supervisor.Handle(Exited{"recorder", 0}, 2.3);
  EXPECT_TRUE(supervisor.finished());
  EXPECT_EQ(supervisor.exit_code(), 0);
}

TEST(SupervisorTest, WaitsForAllSources) {
  Supervisor supervisor({{"left", {}, true}, {"right", {}, true}}, true);
  supervisor.Handle(TimePassed{}, 0.0);
  supervisor.Handle(Exited{"left", 1, false, "exit code 1"}, 1.0);
  EXPECT_FALSE(supervisor.finished());
  supervisor.Handle(Exited{"right", 0}, 2.0);
  EXPECT_TRUE(supervisor.finished());
  EXPECT_EQ(supervisor.exit_code(), 1);
}

TEST(SupervisorTest, StopsInOrderWhenAModuleDiesAndKeepsItsCode) {
  Supervisor supervisor = RunningChain();
  EXPECT_THAT(Words(supervisor.Handle(Exited{"filter", 2, false, "exit code 2"}, 2.0)),
              ElementsAre("say filter ended with exit code 2", "stop source", "stop exporter"));
  EXPECT_THAT(Words(supervisor.Handle(Exited{"source", 1, false, "exit code 1"}, 2.1)),
              ElementsAre("say source ended with exit code 1"));
  supervisor.Handle(Exited{"exporter", 0}, 2.2);
  supervisor.Handle(Exited{"recorder", 0}, 2.3);
  EXPECT_TRUE(supervisor.finished());
  EXPECT_EQ(supervisor.exit_code(), 2);
}

TEST(SupervisorTest, TakesACrashOfTheSourceForAFailure) {
  Supervisor supervisor = RunningChain();
  const auto words = Words(supervisor.Handle(Exited{"source", 1, true, "signal 11"}, 2.0));
  EXPECT_THAT(words, ElementsAre("say source ended with signal 11", "stop filter"));
  EXPECT_EQ(supervisor.exit_code(), 1);
}

TEST(SupervisorTest, TakesAnEarlyEndOfAConsumerForAFailureEvenWithCodeZero) {
  Supervisor supervisor = RunningChain();
  EXPECT_THAT(Words(supervisor.Handle(Exited{"exporter", 0}, 2.0)),
              ElementsAre("say exporter ended before its input did", "stop source"));
  EXPECT_EQ(supervisor.exit_code(), 1);
}

TEST(SupervisorTest, ReportsAFailureDuringTheDrain) {
  Supervisor supervisor = RunningChain();
  supervisor.Handle(Exited{"source", 0}, 2.0);
  supervisor.Handle(Exited{"filter", 1, false, "exit code 1"}, 2.1);
  EXPECT_EQ(supervisor.exit_code(), 1);
}

TEST(SupervisorTest, FailsWhenANodeIsNotReadyInTime) {
  Node slow{"slow", {}};
  slow.start_limit_s = 3.0;
  Supervisor supervisor({slow, {"source", {"slow"}, true}}, true);
  supervisor.Handle(TimePassed{}, 10.0);
  EXPECT_THAT(Words(supervisor.Handle(TimePassed{}, 13.0)), IsEmpty());
  EXPECT_THAT(Words(supervisor.Handle(TimePassed{}, 13.1)),
              ElementsAre("say slow is not ready 3 s after its start", "stop slow"));
  supervisor.Handle(Exited{"slow", 0}, 13.2);
  EXPECT_TRUE(supervisor.finished());
  EXPECT_EQ(supervisor.exit_code(), 1);
}

TEST(SupervisorTest, KillsWhatOutlastsItsGracePeriod) {
  Supervisor supervisor = RunningChain();
  supervisor.Handle(Exited{"source", 0}, 2.0);
  EXPECT_THAT(Words(supervisor.Handle(TimePassed{}, 7.0)), IsEmpty());
  EXPECT_THAT(Words(supervisor.Handle(TimePassed{}, 7.1)),
              ElementsAre(HasSubstr("filter still runs 5 s"), "kill filter"));
  EXPECT_THAT(Words(supervisor.Handle(Exited{"filter", 1, true, "signal 9"}, 7.2)),
              ElementsAre("stop exporter"));
  EXPECT_EQ(supervisor.exit_code(), 1);
}

TEST(SupervisorTest, EndsAFiniteRunCutShortBySignalWith128PlusItsNumber) {
  Supervisor supervisor = RunningChain(true);
  EXPECT_THAT(Words(supervisor.Handle(Interrupted{15}, 2.0)),
              ElementsAre("say stopping on signal 15", "stop source"));
  EXPECT_EQ(supervisor.exit_code(), 143);
}

TEST(SupervisorTest, EndsALiveRunOnASignalWithZero) {
  Supervisor supervisor = RunningChain(false);
  supervisor.Handle(Interrupted{2}, 2.0);
  for (const char* name : {"source", "filter", "exporter", "recorder"}) {
    supervisor.Handle(Exited{name, 0}, 2.1);
  }
  EXPECT_TRUE(supervisor.finished());
  EXPECT_EQ(supervisor.exit_code(), 0);
}

TEST(SupervisorTest, KillsAllAtTheSecondSignal) {
  Supervisor supervisor = RunningChain();
  supervisor.Handle(Interrupted{2}, 2.0);
  EXPECT_THAT(Words(supervisor.Handle(Interrupted{2}, 2.1)),
              ElementsAre("kill recorder", "kill source", "kill filter", "kill exporter"));
}

TEST(SupervisorTest, StartsNothingMoreAfterAFailure) {
  Supervisor supervisor(Chain(), true);
  supervisor.Handle(TimePassed{}, 0.0);
  supervisor.Handle(Ready{"recorder"}, 0.1);
  EXPECT_THAT(Words(supervisor.Handle(Exited{"exporter", 2, false, "exit code 2"}, 0.2)),
              ElementsAre("say exporter ended with exit code 2", "stop recorder"));
}

TEST(SupervisorTest, RefusesNodesThatDoNotFitTogether) {
  EXPECT_THROW(Supervisor({{"a", {"b"}}}, true), std::logic_error);
  EXPECT_THROW(Supervisor({{"a", {}}, {"a", {}}}, true), std::logic_error);
}

}  // namespace
}  // namespace declutter::launcher
