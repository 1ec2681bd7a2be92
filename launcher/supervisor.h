#pragma once

#include <map>
#include <string>
#include <variant>
#include <vector>

#include "launcher/hang_watch.h"
#include "launcher/restart_policy.h"
#include "launcher/succession.h"

namespace declutter::launcher {

// A process as the supervisor sees it.
struct Node {
  std::string name;
  std::vector<std::string> downstream;  // consumers and the like: ready before this starts,
                                        // stopped after it
  bool is_source = false;               // may end by itself: 0 or 1 is the end of its input
  double start_limit_s = 20.0;          // from start to ready
  double grace_period_s = 5.0;          // from terminate to kill
  bool is_required = true;              // its failure ends the run
  RestartRule restart = {};
  double hang_limit_s = HangWatch::kNever;
};

// What happened.
struct Ready {
  std::string name;
};
struct Beat {
  std::string name;
  long num_done = 0;     // grows with each frame that is finished or given out
  bool is_busy = false;  // a frame is begun or waits
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
struct Asked {  // by a user, of one process
  enum class Verb { kStart, kStop, kRestart, kSwap };
  Verb verb;
  std::string name;
};
struct SuccessorBeat {
  std::string name;
  bool has_input = false;  // a whole frame waits in it
};
struct SuccessorExited {
  std::string name;
  std::string how = {};
};
struct TimePassed {};
using Event = std::variant<Ready, Beat, Exited, Interrupted, Asked, SuccessorBeat, SuccessorExited,
                           TimePassed>;

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
struct StartSuccessor {  // to hear everything and do nothing
  std::string name;
};
struct EndSuccessor {  // at once
  std::string name;
};
struct Promote {  // the successor to the process that it follows, which has ended
  std::string name;
};
struct Adopt {  // what was promoted: it will not be reverted any more
  std::string name;
};
struct Revert {  // to what was there before the successor, which has ended; Start follows
  std::string name;
};
using Action =
    std::variant<Start, Terminate, Kill, Say, StartSuccessor, EndSuccessor, Promote, Adopt, Revert>;

// Of a process. Pausing: it starts again in a moment. Stopped: a user asked for it. Ended: for
// good.
enum class State {
  kWaiting,
  kStarting,
  kRunning,
  kTerminating,
  kKilled,
  kPausing,
  kStopped,
  kEnded
};

// True while there is a process.
bool Lives(State state);

// Decides when each process of a graph starts and stops. Holds no process, clock or socket: what it
// asks for is a function of the events and their times alone.
//
// A node starts when everything downstream of it is ready, so no message is lost; when the run
// ends, a node is terminated when everything upstream of it has ended, so each drains what is on
// its way. A process that fails starts again as its rule says, except after exit code 2, which says
// that it never can. The run ends when all sources have ended, when a required process has failed
// for good, or on a signal. A swap ends a process when its successor has heard a whole frame, and
// promotes that when it has ended; what goes wrong before leaves the old one where it is, and when
// the new one ends before its first frame the old one starts again.
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

  bool is_stopping() const { return is_stopping_; }
  State state(const std::string& name) const { return processes_.at(name).state; }
  double since_s(const std::string& name) const { return processes_.at(name).since_s; }
  int num_restarts(const std::string& name) const { return processes_.at(name).num_restarts; }
  int num_swaps(const std::string& name) const { return processes_.at(name).num_swaps; }
  bool is_swapping(const std::string& name) const {
    return processes_.at(name).succession.is_under_way();
  }

 private:
  // What follows the end of a process that was asked or forced to end before the run does.
  enum class Then { kRule, kStay, kStart, kPromote };
  struct Process {
    explicit Process(Node n)
        : node(std::move(n)), backoff(node.restart), watch(node.hang_limit_s) {}

    Node node;
    std::vector<std::string> upstream;
    State state = State::kWaiting;
    double since_s = 0.0;  // when the state was entered
    double due_s = 0.0;    // when it starts again, if pausing
    Then then = Then::kRule;
    bool was_started = false;
    int num_restarts = 0;
    int num_swaps = 0;
    Succession succession;
    Backoff backoff;
    HangWatch watch;
  };

  void On(const Ready& event, double now_s);
  void On(const Beat& event, double now_s);
  void On(const Exited& event, double now_s);
  void On(const Interrupted& event, double now_s);
  void On(const Asked& event, double now_s);
  void On(const SuccessorBeat& event, double now_s);
  void On(const SuccessorExited& event, double now_s);
  void On(const TimePassed&, double) {}

  void JudgeLastEnd(const Exited& event, State was);
  void ApplyRule(const Exited& event, State was, double ran_s, double now_s);
  void StartNow(Process* process, double now_s);
  void TerminateNow(Process* process, Then then, double now_s);
  void KillNow(Process* process, double now_s);
  void BeginSwap(Process* process, double now_s);
  void PromoteNow(Process* process, double now_s);
  void AdoptNow(Process* process);
  void RevertNow(Process* process, const Exited& event, double now_s);
  void CancelSwap(Process* process);

  // Ends a process that gets nowhere; its rule says what then.
  void GiveUp(Process* process, const std::string& why, double now_s);

  void StartWhatCan(double now_s);
  void RestartWhatIsDue(double now_s);
  void CheckStartLimits(double now_s);
  void CheckHangs(double now_s);
  void CheckSwaps(double now_s);
  void StopWhatCan(double now_s);
  void KillWhatLingers(double now_s);

  static void Enter(State state, Process* process, double now_s);
  void Fail(int code, const std::string& text);
  void Tell(const std::string& text) { actions_.push_back(Say{text}); }
  bool IsServed(const Process& process) const;
  bool AllEnded(const std::vector<std::string>& names) const;
  bool AllSourcesEnded() const;
  static std::string Seconds(double seconds);

  template <typename Visit>
  void ForEachInOrder(const Visit& visit) {
    for (const std::string& name : order_) visit(processes_.at(name));
  }

  std::vector<std::string> order_;  // as given: actions come in this order
  std::map<std::string, Process> processes_;
  std::vector<Action> actions_;
  bool is_finite_;
  bool is_stopping_ = false;
  int num_signals_ = 0;
  int exit_code_ = 0;
};

}  // namespace declutter::launcher
