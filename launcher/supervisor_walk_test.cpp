// Every sequence of events up to a length, on small graphs with each restart rule, against what
// must hold whatever happens.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <random>
#include <set>

#include "launcher/supervisor.h"
#include "launcher/supervisor_words.h"

namespace declutter::launcher {
namespace {

using When = RestartRule::When;

constexpr double kStep_s = 0.7;      // longer than a first delay, shorter than every limit
constexpr double kLongStep_s = 2.5;  // longer than every limit of a pair

// Something that happens, and when: so long after what was before.
struct Happening {
  Event event;
  double after_s = 0.01;
};

// A supervisor with the processes that it believes in.
class World {
 public:
  World(const std::vector<Node>& nodes, bool is_finite)
      : supervisor_(nodes, is_finite), nodes_(nodes) {
    Give({TimePassed{}});
  }

  // What can happen now.
  std::vector<Happening> Possible() const {
    std::vector<Happening> events = {{TimePassed{}, kStep_s}, {TimePassed{}, kLongStep_s}};
    if (num_signals_ < 2) events.push_back({Interrupted{15}});
    for (const Node& node : nodes_) {
      const auto add = [&events](const Event& event) { events.push_back({event}); };
      if (alive_.count(node.name) == 0) {
        add(Asked{Asked::Verb::kStart, node.name});
        continue;
      }
      if (supervisor_.state(node.name) == State::kStarting) add(Ready{node.name});
      if (supervisor_.state(node.name) == State::kRunning) {
        events.push_back({Beat{node.name, 0, true}, kStep_s});
        add(Beat{node.name, 1, false});
      }
      add(Asked{Asked::Verb::kStop, node.name});
      add(Asked{Asked::Verb::kSwap, node.name});
      if (successors_.count(node.name) != 0) {
        add(SuccessorBeat{node.name, true});
        add(SuccessorExited{node.name, "exit code 1"});
      }
      add(Asked{Asked::Verb::kRestart, node.name});
      if (killed_.count(node.name) == 0) {
        add(Exited{node.name, 0, false, "exit code 0"});
        add(Exited{node.name, 1, false, "exit code 1"});
        add(Exited{node.name, 2, false, "exit code 2"});
      }
      add(Exited{node.name, 1, true, "signal 9"});
    }
    return events;
  }

  void Give(const Happening& happening) {
    const Event& event = happening.event;
    now_s_ += happening.after_s;
    if (std::holds_alternative<Interrupted>(event)) ++num_signals_;
    if (const auto* exited = std::get_if<Exited>(&event)) Bury(*exited);
    if (const auto* exited = std::get_if<SuccessorExited>(&event)) successors_.erase(exited->name);
    if (const auto* asked = std::get_if<Asked>(&event)) {
      // The old process of a swap that fails starts again.
      if (asked->verb != Asked::Verb::kStop) wanted_.insert(asked->name);
    }
    const bool was_stopping = supervisor_.is_stopping();
    for (const Action& action : supervisor_.Handle(event, now_s_)) Check(action, was_stopping);
    for (const Node& node : nodes_) CheckState(node.name);
    ASSERT_EQ(supervisor_.finished(), supervisor_.is_stopping() && alive_.empty());
    ASSERT_TRUE(!supervisor_.is_stopping() || (successors_.empty() && on_trial_.empty()));
    ASSERT_FALSE(was_stopping && !supervisor_.is_stopping());
  }

  // Everybody obeys from now on: the run must come to its end.
  void End() {
    Give({Interrupted{15}});
    for (int turn = 0; turn < 100 && !supervisor_.finished(); ++turn) {
      std::string name;
      for (const std::string& alive : alive_) {
        const State state = supervisor_.state(alive);
        if (state == State::kTerminating || state == State::kKilled) name = alive;
      }
      if (name.empty()) break;
      Give({Exited{name, 0, false, "exit code 0"}});
    }
    ASSERT_TRUE(supervisor_.finished());
    // No failure hides another, and 2 comes only from a process that said so.
    ASSERT_TRUE(supervisor_.exit_code() != 2 || has_ended_with_two_);
  }

 private:
  void Check(const Action& action, bool was_stopping) {
    if (const auto* start = std::get_if<Start>(&action)) {
      CheckStart(start->name);
      ASSERT_FALSE(was_stopping) << start->name << " started at the end";
    } else if (const auto* terminate = std::get_if<Terminate>(&action)) {
      ASSERT_EQ(alive_.count(terminate->name), 1u);
      if (supervisor_.is_stopping()) CheckUpstreamIsGone(terminate->name);
    } else if (const auto* kill = std::get_if<Kill>(&action)) {
      ASSERT_EQ(alive_.count(kill->name), 1u);
      killed_.insert(kill->name);
    } else if (const auto* next = std::get_if<StartSuccessor>(&action)) {
      ASSERT_TRUE(successors_.insert(next->name).second);
      ASSERT_FALSE(was_stopping);
    } else if (const auto* dropped = std::get_if<EndSuccessor>(&action)) {
      ASSERT_EQ(successors_.erase(dropped->name), 1u);
    } else if (const auto* promoted = std::get_if<Promote>(&action)) {
      ASSERT_EQ(successors_.erase(promoted->name), 1u);
      ASSERT_TRUE(alive_.insert(promoted->name).second) << "two of " << promoted->name;
      ASSERT_TRUE(on_trial_.insert(promoted->name).second);
    } else if (const auto* adopted = std::get_if<Adopt>(&action)) {
      ASSERT_EQ(on_trial_.erase(adopted->name), 1u);
    } else if (const auto* reverted = std::get_if<Revert>(&action)) {
      ASSERT_EQ(on_trial_.erase(reverted->name), 1u);
      ASSERT_EQ(alive_.count(reverted->name), 0u);
    }
  }

  void Bury(const Exited& exited) {
    ASSERT_EQ(alive_.erase(exited.name), 1u);
    killed_.erase(exited.name);
    if (exited.code != 2) return;
    has_ended_with_two_ = true;
    // A user's wish that came before is still carried out.
    if (wanted_.count(exited.name) == 0) refused_.insert(exited.name);
  }

  void CheckStart(const std::string& name) {
    ASSERT_TRUE(alive_.insert(name).second) << "two of " << name;
    const bool is_wanted = wanted_.erase(name) != 0;
    ASSERT_TRUE(refused_.count(name) == 0 || is_wanted) << name << " started after exit code 2";
    refused_.erase(name);
    const bool is_first = started_.insert(name).second;
    if (is_wanted || !is_first) return;
    for (const Node& node : nodes_) {
      if (node.name != name) continue;
      for (const std::string& consumer : node.downstream) {
        const State state = supervisor_.state(consumer);
        ASSERT_TRUE(state == State::kRunning || state == State::kStopped ||
                    (state == State::kEnded && !IsRequired(consumer)))
            << name << " started before " << consumer;
      }
    }
  }

  bool IsRequired(const std::string& name) const {
    return std::any_of(nodes_.begin(), nodes_.end(),
                       [&](const Node& node) { return node.name == name && node.is_required; });
  }

  void CheckUpstreamIsGone(const std::string& name) {
    for (const Node& node : nodes_) {
      const auto& consumers = node.downstream;
      if (std::find(consumers.begin(), consumers.end(), name) == consumers.end()) continue;
      ASSERT_EQ(alive_.count(node.name), 0u) << name << " stopped before " << node.name;
    }
  }

  // The supervisor never believes in a process that is gone, nor forgets one that is there.
  void CheckState(const std::string& name) {
    const State state = supervisor_.state(name);
    const bool lives = state == State::kStarting || state == State::kRunning ||
                       state == State::kTerminating || state == State::kKilled;
    ASSERT_EQ(lives, alive_.count(name) == 1) << name;
    ASSERT_EQ(supervisor_.is_swapping(name), successors_.count(name) + on_trial_.count(name) == 1)
        << name;
  }

  Supervisor supervisor_;
  std::vector<Node> nodes_;
  std::set<std::string> alive_;
  std::set<std::string> killed_;
  std::set<std::string> successors_;
  std::set<std::string> on_trial_;  // successors that were promoted
  std::set<std::string> started_;
  std::set<std::string> wanted_;   // a user has asked for a start that has not come yet
  std::set<std::string> refused_;  // ended with 2
  double now_s_ = 0.0;
  int num_signals_ = 0;
  bool has_ended_with_two_ = false;
};

std::vector<Node> Pair(When when, bool is_required) {
  std::vector<Node> nodes = {{"source", {"sink"}, true}, {"sink", {}}};
  for (Node& node : nodes) {
    node.restart = {when, 0.5, 1.0, 2};
    node.is_required = is_required;
    node.start_limit_s = 2.0;
    node.grace_period_s = 1.0;
    node.hang_limit_s = 2.0;
  }
  return nodes;
}

int WalkAll(const World& world, int num_events) {
  if (testing::Test::HasFatalFailure()) return 0;
  World ended = world;
  ended.End();
  if (num_events == 0) return 1;
  int num_walks = 0;
  for (const Happening& happening : world.Possible()) {
    World next = world;
    next.Give(happening);
    num_walks += WalkAll(next, num_events - 1);
  }
  return num_walks;
}

// With each rule; walk is given a graph that has just begun.
void ForEachRule(const std::function<void(World)>& walk) {
  for (const When when : {When::kNever, When::kOnFailure, When::kAlways}) {
    for (const bool is_required : {false, true}) {
      for (const bool is_finite : {false, true}) walk(World(Pair(when, is_required), is_finite));
    }
  }
}

TEST(SupervisorWalkTest, HoldsInEverySequenceOfFiveEventsFromTheStart) {
  ForEachRule([](const World& world) { EXPECT_GT(WalkAll(world, 5), 10000); });
}

TEST(SupervisorWalkTest, HoldsInEverySequenceOfFourEventsWhileAllRun) {
  ForEachRule([](World world) {
    world.Give({Ready{"sink"}});
    world.Give({Ready{"source"}});
    EXPECT_GT(WalkAll(world, 4), 10000);
  });
}

TEST(SupervisorWalkTest, HoldsInLongRandomSequencesOnALargerGraph) {
  std::mt19937 random(1);
  for (int walk = 0; walk < 1000 && !HasFatalFailure(); ++walk) {
    std::vector<Node> nodes = {{"logger", {}},
                               {"left", {"join", "logger"}, true},
                               {"right", {"join", "logger"}, true},
                               {"join", {"sink", "logger"}},
                               {"sink", {"logger"}}};
    for (Node& node : nodes) {
      node.restart = {static_cast<When>(random() % 3), 0.5, 1.0, 3};
      node.is_required = random() % 2 == 0;
      node.hang_limit_s = 3.0;
    }
    World world(nodes, random() % 2 == 0);
    for (int i = 0; i < 60 && !HasFatalFailure(); ++i) {
      const std::vector<Happening> events = world.Possible();
      world.Give(events[random() % events.size()]);
    }
    world.End();
  }
}

}  // namespace
}  // namespace declutter::launcher
