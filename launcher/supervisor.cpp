#include "launcher/supervisor.h"

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace declutter::launcher {
namespace {

std::string Seconds(double seconds) {
  char text[32];
  std::snprintf(text, sizeof(text), "%g s", seconds);
  return text;
}

}  // namespace

Supervisor::Supervisor(std::vector<Node> nodes, bool is_finite) : is_finite_(is_finite) {
  for (Node& node : nodes) {
    order_.push_back(node.name);
    Process process;
    process.node = std::move(node);
    if (!processes_.emplace(order_.back(), std::move(process)).second) {
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
  if (!is_stopping_) StartWhatCan(now_s);
  if (!is_stopping_ && AllSourcesEnded()) is_stopping_ = true;
  if (is_stopping_) StopWhatCan(now_s);
  KillWhatLingers(now_s);
  return std::exchange(actions_, {});
}

void Supervisor::On(const Ready& event, double now_s) {
  Process& process = processes_.at(event.name);
  if (process.state != State::kStarting) return;
  process.state = State::kRunning;
  process.since_s = now_s;
}

void Supervisor::On(const Exited& event, double now_s) {
  Process& process = processes_.at(event.name);
  const bool is_asked = process.state == State::kTerminating;
  const bool is_end_of_input = process.node.is_source && !event.by_signal && event.code <= 1;
  if (process.state != State::kKilled && event.code != 0) {
    // Code 1 of a source is the end of an input of which some could not be read.
    if (is_end_of_input || is_asked) {
      if (exit_code_ == 0) exit_code_ = event.code;
      actions_.push_back(Say{event.name + " ended with " + event.how});
    } else {
      Fail(event.code, event.name + " ended with " + event.how);
    }
  } else if (event.code == 0 && !is_end_of_input && !is_stopping_) {
    Fail(1, event.name + " ended before its input did");
  }
  process.state = State::kEnded;
  process.since_s = now_s;
}

void Supervisor::On(const Interrupted& event, double now_s) {
  ++num_signals_;
  if (!is_stopping_) {
    is_stopping_ = true;
    if (is_finite_ && exit_code_ == 0) exit_code_ = 128 + event.signal;
    actions_.push_back(Say{"stopping on signal " + std::to_string(event.signal)});
  }
  if (num_signals_ < 2) return;
  for (const std::string& name : order_) {
    Process& process = processes_.at(name);
    if (process.state == State::kWaiting || process.state == State::kEnded) continue;
    process.state = State::kKilled;
    process.since_s = now_s;
    actions_.push_back(Kill{name});
  }
}

void Supervisor::StartWhatCan(double now_s) {
  for (const std::string& name : order_) {
    Process& process = processes_.at(name);
    if (process.state != State::kWaiting) continue;
    if (!AllAre(process.node.downstream, State::kRunning)) continue;
    process.state = State::kStarting;
    process.since_s = now_s;
    actions_.push_back(Start{name});
  }
}

void Supervisor::CheckStartLimits(double now_s) {
  for (const std::string& name : order_) {
    const Process& process = processes_.at(name);
    if (process.state != State::kStarting) continue;
    if (now_s - process.since_s <= process.node.start_limit_s) continue;
    Fail(1, name + " is not ready " + Seconds(process.node.start_limit_s) + " after its start");
    return;
  }
}

void Supervisor::StopWhatCan(double now_s) {
  // What never started counts as ended; a node may then become free to stop in the same pass.
  for (auto& [name, process] : processes_) {
    if (process.state == State::kWaiting) process.state = State::kEnded;
  }
  for (const std::string& name : order_) {
    Process& process = processes_.at(name);
    if (process.state != State::kStarting && process.state != State::kRunning) continue;
    if (!AllAre(process.upstream, State::kEnded)) continue;
    process.state = State::kTerminating;
    process.since_s = now_s;
    actions_.push_back(Terminate{name});
  }
}

void Supervisor::KillWhatLingers(double now_s) {
  for (const std::string& name : order_) {
    Process& process = processes_.at(name);
    if (process.state != State::kTerminating) continue;
    if (now_s - process.since_s <= process.node.grace_period_s) continue;
    process.state = State::kKilled;
    process.since_s = now_s;
    Fail(1, name + " still runs " + Seconds(process.node.grace_period_s) +
                " after it was asked to stop: killed");
    actions_.push_back(Kill{name});
  }
}

void Supervisor::Fail(int code, const std::string& text) {
  if (exit_code_ == 0) exit_code_ = code;
  is_stopping_ = true;
  actions_.push_back(Say{text});
}

bool Supervisor::finished() const {
  return is_stopping_ && std::all_of(processes_.begin(), processes_.end(), [](const auto& entry) {
           return entry.second.state == State::kEnded;
         });
}

bool Supervisor::AllAre(const std::vector<std::string>& names, State state) const {
  return std::all_of(names.begin(), names.end(),
                     [&](const std::string& name) { return processes_.at(name).state == state; });
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
