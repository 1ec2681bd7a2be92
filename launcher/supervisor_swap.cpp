// How a new process takes the place of a running one.
#include "launcher/supervisor.h"

namespace declutter::launcher {

void Supervisor::BeginSwap(Process* process, double now_s) {
  if (process->state != State::kRunning || process->succession.is_under_way()) return;
  process->succession.Begin(now_s);
  actions_.push_back(StartSuccessor{process->node.name});
}

void Supervisor::On(const SuccessorBeat& event, double now_s) {
  processes_.at(event.name).succession.Beat(event.has_input, now_s);
}

void Supervisor::On(const SuccessorExited& event, double) {
  Process& process = processes_.at(event.name);
  if (!process.succession.is_under_way()) return;
  process.succession.Cancel();
  const bool is_too_late = process.then == Then::kPromote && Lives(process.state);
  if (is_too_late) process.then = Then::kStart;
  Tell("the successor of " + event.name + " ended with " + event.how + "; " + event.name +
       (is_too_late ? " starts again" : " goes on"));
}

void Supervisor::CheckSwaps(double now_s) {
  ForEachInOrder([&](Process& process) {
    const double limit_s = process.node.start_limit_s;
    if (process.succession.is_late(limit_s, now_s)) {
      Tell("the successor of " + process.node.name + " is not ready " + Seconds(limit_s) +
           " after its start; " + process.node.name + " goes on");
      CancelSwap(&process);
    }
    if (process.state != State::kRunning) return;
    if (process.succession.has_passed(now_s)) AdoptNow(&process);
    if (!process.succession.is_due(now_s)) return;
    process.succession.TakeOver(now_s);
    TerminateNow(&process, Then::kPromote, now_s);
  });
}

void Supervisor::PromoteNow(Process* process, double now_s) {
  process->succession.Try(now_s);
  process->then = Then::kRule;
  Enter(State::kRunning, process, now_s);
  process->watch.Start(now_s);
  actions_.push_back(Promote{process->node.name});
}

void Supervisor::AdoptNow(Process* process) {
  process->succession.Cancel();
  ++process->num_swaps;
  actions_.push_back(Adopt{process->node.name});
}

void Supervisor::RevertNow(Process* process, const Exited& event, double now_s) {
  process->succession.Cancel();
  Tell("the successor of " + event.name + " ended with " + event.how + " before its first frame; " +
       event.name + " starts again as it was");
  actions_.push_back(Revert{event.name});
  StartNow(process, now_s);
}

void Supervisor::CancelSwap(Process* process) {
  if (process->succession.is_on_trial()) return AdoptNow(process);
  if (!process->succession.is_under_way()) return;
  process->succession.Cancel();
  actions_.push_back(EndSuccessor{process->node.name});
}

}  // namespace declutter::launcher
