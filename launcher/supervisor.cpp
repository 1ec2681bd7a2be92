#include "launcher/supervisor.h"

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace declutter::launcher {
namespace {

constexpr int kBadConfig = 2;  // exit code: what cannot work once cannot work again

bool EndsByItself(const Node& node, const Exited& event) {
  return node.is_source && !event.by_signal && event.code <= 1;
}

}  // namespace

bool Lives(State state) {
  return state == State::kStarting || state == State::kRunning || state == State::kTerminating ||
         state == State::kKilled;
}

Supervisor::Supervisor(std::vector<Node> nodes, bool is_finite) : is_finite_(is_finite) {
  for (Node& node : nodes) {
    order_.push_back(node.name);
    if (!processes_.emplace(order_.back(), Process(std::move(node))).second) {
      throw std::logic_error("two nodes named " + order_.back());
    }
  }
  for (const std::string& name : order_) {
    for (const std::string& consumer : processes_.at(name).node.downstream) {
      const auto found = processes_.find(consumer);
      if (found == processes_.end()) throw std::logic_error("no node named " + consumer);
      found->second.upstream.push_back(name);
    }
  }
}

std::vector<Action> Supervisor::Handle(const Event& event, double now_s) {
  actions_.clear();
  std::visit([&](const auto& e) { On(e, now_s); }, event);
  if (!is_stopping_) CheckStartLimits(now_s);
  if (!is_stopping_) CheckHangs(now_s);
  if (!is_stopping_) CheckSwaps(now_s);
  if (!is_stopping_) RestartWhatIsDue(now_s);
  if (!is_stopping_) StartWhatCan(now_s);
  if (!is_stopping_ && AllSourcesEnded()) is_stopping_ = true;
  if (is_stopping_) StopWhatCan(now_s);
  KillWhatLingers(now_s);
  return std::exchange(actions_, {});
}

std::string Supervisor::Seconds(double seconds) {
  char text[32];
  std::snprintf(text, sizeof(text), "%g s", seconds);
  return text;
}

void Supervisor::Enter(State state, Process* process, double now_s) {
  process->state = state;
  process->since_s = now_s;
}

void Supervisor::On(const Ready& event, double now_s) {
  Process& process = processes_.at(event.name);
  if (process.state != State::kStarting) return;
  Enter(State::kRunning, &process, now_s);
  process.watch.Start(now_s);
}

void Supervisor::On(const Beat& event, double now_s) {
  Process& process = processes_.at(event.name);
  process.watch.Beat(event.num_done, event.is_busy, now_s);
  if (process.succession.is_on_trial() && event.num_done > 0) AdoptNow(&process);
}

void Supervisor::On(const Exited& event, double now_s) {
  Process& process = processes_.at(event.name);
  const State was = process.state;
  const double ran_s = was == State::kRunning ? now_s - process.since_s : 0.0;
  Enter(State::kEnded, &process, now_s);
  if (is_stopping_) return JudgeLastEnd(event, was);
  if (process.then != Then::kRule && was != State::kKilled && event.code != 0) {
    Tell(event.name + " ended with " + event.how);
  }
  if (process.then == Then::kPromote) return PromoteNow(&process, now_s);
  const bool is_end_of_input = EndsByItself(process.node, event) && event.code == 0;
  if (process.succession.is_on_trial() && process.then == Then::kRule && !is_end_of_input) {
    return RevertNow(&process, event, now_s);
  }
  CancelSwap(&process);
  if (process.then == Then::kRule) return ApplyRule(event, was, ran_s, now_s);
  if (process.then == Then::kStart) return StartNow(&process, now_s);
  Enter(State::kStopped, &process, now_s);
}

void Supervisor::JudgeLastEnd(const Exited& event, State was) {
  const Node& node = processes_.at(event.name).node;
  if (was == State::kKilled || event.code == 0) return;
  // Code 1 of a source is the end of an input of which some could not be read.
  if (node.is_required && exit_code_ == 0) exit_code_ = event.code;
  Tell(event.name + " ended with " + event.how);
}

void Supervisor::ApplyRule(const Exited& event, State was, double ran_s, double now_s) {
  using When = RestartRule::When;
  Process& process = processes_.at(event.name);
  const bool was_killed = was == State::kKilled;
  const bool ends_by_itself = !was_killed && EndsByItself(process.node, event);
  const bool is_end_of_input = ends_by_itself && (event.code == 0 || is_finite_);
  const When when = process.node.restart.when;
  std::string text = event.name + (was_killed               ? " was killed"
                                   : event.code != 0        ? " ended with " + event.how
                                   : process.node.is_source ? " ended"
                                                            : " ended before its input did");
  if (event.code != kBadConfig &&
      (when == When::kAlways || (when == When::kOnFailure && !is_end_of_input))) {
    if (const auto delay_s = process.backoff.Next(ran_s)) {
      Enter(State::kPausing, &process, now_s);
      process.due_s = now_s + *delay_s;
      return Tell(text + "; starts again in " + Seconds(*delay_s));
    }
    text += " after " + std::to_string(process.node.restart.max_in_a_row) + " restarts in a row";
  } else if (ends_by_itself) {
    if (event.code == 0) return;
    if (process.node.is_required && exit_code_ == 0) exit_code_ = event.code;
    return Tell(text);
  }
  if (!process.node.is_required) return Tell(text + "; the graph goes on without it");
  Fail(event.code == 0 ? 1 : event.code, text);
}

void Supervisor::On(const Interrupted& event, double now_s) {
  ++num_signals_;
  if (!is_stopping_) {
    is_stopping_ = true;
    if (is_finite_ && exit_code_ == 0) exit_code_ = 128 + event.signal;
    Tell("stopping on signal " + std::to_string(event.signal));
  }
  if (num_signals_ < 2) return;
  ForEachInOrder([&](Process& process) {
    if (Lives(process.state)) KillNow(&process, now_s);
  });
}

void Supervisor::On(const Asked& event, double now_s) {
  if (is_stopping_) return;
  Process& process = processes_.at(event.name);
  const bool is_up = process.state == State::kStarting || process.state == State::kRunning;
  const Then then = event.verb == Asked::Verb::kStop ? Then::kStay : Then::kStart;
  process.backoff.Reset();
  if (event.verb == Asked::Verb::kSwap) return BeginSwap(&process, now_s);
  CancelSwap(&process);
  if (is_up && event.verb == Asked::Verb::kStart) return;
  if (is_up) return TerminateNow(&process, then, now_s);
  if (Lives(process.state)) {
    process.then = then;
  } else if (then == Then::kStart) {
    StartNow(&process, now_s);
  } else {
    Enter(State::kStopped, &process, now_s);
  }
}

void Supervisor::StartNow(Process* process, double now_s) {
  if (process->was_started) ++process->num_restarts;
  process->was_started = true;
  process->then = Then::kRule;
  Enter(State::kStarting, process, now_s);
  actions_.push_back(Start{process->node.name});
}

void Supervisor::TerminateNow(Process* process, Then then, double now_s) {
  process->then = then;
  Enter(State::kTerminating, process, now_s);
  actions_.push_back(Terminate{process->node.name});
}

void Supervisor::KillNow(Process* process, double now_s) {
  Enter(State::kKilled, process, now_s);
  actions_.push_back(Kill{process->node.name});
}

void Supervisor::Fail(int code, const std::string& text) {
  if (exit_code_ == 0) exit_code_ = code;
  is_stopping_ = true;
  Tell(text);
}

bool Supervisor::finished() const {
  return is_stopping_ && std::all_of(processes_.begin(), processes_.end(), [](const auto& entry) {
           return entry.second.state == State::kEnded;
         });
}

bool Supervisor::IsServed(const Process& process) const {
  const auto& names = process.node.downstream;
  return std::all_of(names.begin(), names.end(), [&](const std::string& name) {
    const Process& consumer = processes_.at(name);
    return consumer.state == State::kRunning || consumer.state == State::kStopped ||
           (consumer.state == State::kEnded && !consumer.node.is_required);
  });
}

bool Supervisor::AllEnded(const std::vector<std::string>& names) const {
  return std::all_of(names.begin(), names.end(), [&](const std::string& name) {
    return processes_.at(name).state == State::kEnded;
  });
}

bool Supervisor::AllSourcesEnded() const {
  bool has_source = false;
  for (const auto& [name, process] : processes_) {
    if (!process.node.is_source) continue;
    has_source = true;
    if (process.state != State::kEnded) return false;
  }
  return has_source;
}

}  // namespace declutter::launcher
