#pragma once

#include <map>
#include <string>
#include <variant>
#include <vector>

namespace declutter::launcher {

// A process as the supervisor sees it.
struct Node {
  std::string name;
  std::vector<std::string> downstream;  // consumers: ready before this starts, stopped after it
  bool is_source = false;               // may end by itself: 0 or 1 is the end of its input
  double start_limit_s = 20.0;          // from start to ready
  double grace_period_s = 5.0;          // from terminate to kill
};

// What happened.
struct Ready {
  std::string name;
};
struct Exited {
  std::string name;
  int code = 0;            // of exit(), or 1 when a signal ended it
  bool by_signal = false;  // a crash, not a decision of the process
  std::string how = {};    // for people: "exit code 1", "signal 11 (Segmentation fault)"
};
struct Interrupted {
  int signal = 0;
};
struct TimePassed {};
using Event = std::variant<Ready, Exited, Interrupted, TimePassed>;

// What to do about it.
struct Start {
  std::string name;
};
struct Terminate {
  std::string name;
};
struct Kill {
  std::string name;
};
struct Say {
  std::string text;
};
using Action = std::variant<Start, Terminate, Kill, Say>;

// Decides when each process of a graph starts and stops. Holds no process, clock or socket: what it
// asks for is a function of the events and their times alone.
//
// A node starts when everything downstream of it is ready, so no message is lost; when the run
// ends, a node is terminated when everything upstream of it has ended, so each drains what is on
// its way. The run ends when all sources have ended, when a process fails, or on a signal.
class Supervisor {
 public:
  // is_finite: the graph is run over recordings, so a signal cuts it short. nodes must have unique
  // names, known names downstream and no cycle; else throws std::logic_error.
  Supervisor(std::vector<Node> nodes, bool is_finite);

  // now_s: seconds on any clock that does not go back. The first event starts the first nodes.
  std::vector<Action> Handle(const Event& event, double now_s);

  // True when every process has ended.
  bool finished() const;

  // The code of the first failure; 128 + signal when a signal cut a finite run short; 0 when
  // everything went well, which for a live graph includes being stopped by a signal.
  int exit_code() const { return exit_code_; }

 private:
  enum class State { kWaiting, kStarting, kRunning, kTerminating, kKilled, kEnded };
  struct Process {
    Node node;
    std::vector<std::string> upstream;
    State state = State::kWaiting;
    double since_s = 0.0;  // when the state was entered
  };

  void On(const Ready& event, double now_s);
  void On(const Exited& event, double now_s);
  void On(const Interrupted& event, double now_s);
  void On(const TimePassed&, double) {}
  void StartWhatCan(double now_s);
  void CheckStartLimits(double now_s);
  void StopWhatCan(double now_s);
  void KillWhatLingers(double now_s);
  void Fail(int code, const std::string& text);
  bool AllAre(const std::vector<std::string>& names, State state) const;
  bool AllSourcesEnded() const;

  std::vector<std::string> order_;  // as given: actions come in this order
  std::map<std::string, Process> processes_;
  std::vector<Action> actions_;
  bool is_finite_;
  bool is_stopping_ = false;
  int num_signals_ = 0;
  int exit_code_ = 0;
};

}  // namespace declutter::launcher
