// What the supervisor looks at in every turn, whatever the event was.
#include "launcher/supervisor.h"

namespace declutter::launcher {

void Supervisor::StartWhatCan(double now_s) {
  ForEachInOrder([&](Process& process) {
    if (process.state == State::kWaiting && IsServed(process)) StartNow(&process, now_s);
  });
}

void Supervisor::RestartWhatIsDue(double now_s) {
  ForEachInOrder([&](Process& process) {
    if (process.state == State::kPausing && now_s >= process.due_s) StartNow(&process, now_s);
  });
}

void Supervisor::CheckStartLimits(double now_s) {
  ForEachInOrder([&](Process& process) {
    const double limit_s = process.node.start_limit_s;
    if (is_stopping_ || process.state != State::kStarting) return;
    if (now_s - process.since_s <= limit_s) return;
    GiveUp(&process, " is not ready " + Seconds(limit_s) + " after its start", now_s);
  });
}

void Supervisor::CheckHangs(double now_s) {
  ForEachInOrder([&](Process& process) {
    if (is_stopping_ || process.state != State::kRunning) return;
    if (process.watch.is_silent(now_s)) {
      GiveUp(&process, " hangs: no sign of life for " + Seconds(process.watch.silence_limit_s()),
             now_s);
    } else if (process.watch.is_stuck(now_s)) {
      GiveUp(
          &process,
          " hangs: input waits and no frame was finished for " + Seconds(process.watch.limit_s()),
          now_s);
    }
  });
}

void Supervisor::GiveUp(Process* process, const std::string& why, double now_s) {
  const Node& node = process->node;
  const bool may_start_again =
      node.restart.when != RestartRule::When::kNever || process->succession.is_on_trial();
  if (node.is_required && !may_start_again) {
    return Fail(1, node.name + why);
  }
  Tell(node.name + why);
  process->then = Then::kRule;
  KillNow(process, now_s);
}

void Supervisor::StopWhatCan(double now_s) {
  // What does not run counts as ended; a node may then become free to stop in the same pass.
  for (auto& [name, process] : processes_) {
    CancelSwap(&process);
    if (!Lives(process.state)) process.state = State::kEnded;
  }
  ForEachInOrder([&](Process& process) {
    const bool is_up = process.state == State::kStarting || process.state == State::kRunning;
    if (is_up && AllEnded(process.upstream)) TerminateNow(&process, Then::kStay, now_s);
  });
}

void Supervisor::KillWhatLingers(double now_s) {
  ForEachInOrder([&](Process& process) {
    const double limit_s = process.node.grace_period_s;
    if (process.state != State::kTerminating || now_s - process.since_s <= limit_s) return;
    const std::string text = process.node.name + " still runs " + Seconds(limit_s) +
                             " after it was asked to stop: killed";
    if (is_stopping_ && process.node.is_required) {
      Fail(1, text);
    } else {
      Tell(text);
    }
    KillNow(&process, now_s);
  });
}

}  // namespace declutter::launcher
