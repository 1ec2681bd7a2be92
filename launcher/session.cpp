#include "launcher/session.h"

#include <poll.h>
#include <signal.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <stdexcept>
#include <utility>

#include "launcher/monotonic_time.h"
#include "modules/runtime/suggestion.h"

namespace declutter::launcher {
namespace {

constexpr int kTurn_ms = 10;
constexpr int kRefused = 2;

sigset_t HandledSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) sigaddset(&signals, signal);
  return signals;
}

Beat BeatOf(const std::string& name, const module_status_t& status) {
  return {name, status.num_done + status.num_out,
          status.num_waiting > 0 || status.num_in > status.num_done};
}

}  // namespace

void HoldSignals() {
  const sigset_t signals = HandledSignals();
  sigprocmask(SIG_BLOCK, &signals, nullptr);
  signal(SIGPIPE, SIG_IGN);  // whoever reads our stderr may leave; the run goes on
}

Session::Session(Links links, Supervisor supervisor, ProcessMap processes)
    : links_(std::move(links)),
      supervisor_(std::move(supervisor)),
      processes_(std::move(processes)) {
  const sigset_t signals = HandledSignals();
  signal_fd_ = signalfd(-1, &signals, SFD_NONBLOCK | SFD_CLOEXEC);
  if (signal_fd_ < 0) throw std::runtime_error("signals cannot be waited for");
}

Session::~Session() { close(signal_fd_); }

int Session::Run() {
  Decide(TimePassed{});
  while (!supervisor_.finished()) {
    Wait();
    ReadSignals();
    const std::vector<Message> messages = links_.wire->Receive();
    ListenToProcesses(messages);
    ListenToSuccessors(messages);
    ListenToUsers();
    Decide(TimePassed{});
  }
  return supervisor_.exit_code();
}

void Session::Wait() {
  std::vector<pollfd> waited = {
      {signal_fd_, POLLIN, 0}, {links_.wire->fd(), POLLIN, 0}, {links_.control->fd(), POLLIN, 0}};
  for (const auto& [name, process] : processes_) waited.push_back({process->fd(), POLLIN, 0});
  for (const auto& [name, process] : successors_) waited.push_back({process->fd(), POLLIN, 0});
  poll(waited.data(), waited.size(), kTurn_ms);
}

void Session::ReadSignals() {
  signalfd_siginfo signal;
  while (read(signal_fd_, &signal, sizeof(signal)) == sizeof(signal)) {
    if (signal.ssi_signo == SIGCHLD) continue;  // has only ended the wait
    Decide(Interrupted{static_cast<int>(signal.ssi_signo)});
  }
}

void Session::ListenToProcesses(const std::vector<Message>& messages) {
  // What is decided may put another process in the place of one: that waits for the end of the
  // turn.
  std::vector<Event> events;
  for (auto& [name, process] : processes_) {
    for (const Message& message : messages) process->OnMessage(message);
    process->OnTurn(MonotonicSeconds());
    if (process->is_ready()) events.push_back(Ready{name});
    if (const auto status = process->TakeStatus()) {
      vitals_[name].Hear(*status);
      events.push_back(BeatOf(name, *status));
    }
    vitals_[name].Look(process->pid(), MonotonicSeconds());
    if (const auto ending = process->Reap()) {
      events.push_back(Exited{name, ending->code, ending->signal != 0, ending->how});
    }
  }
  for (const Event& event : events) Decide(event);
}

void Session::ListenToSuccessors(const std::vector<Message>& messages) {
  std::vector<Event> events;
  for (auto& [name, process] : successors_) {
    for (const Message& message : messages) process->OnMessage(message);
    process->OnTurn(MonotonicSeconds());
    const auto status = process->TakeStatus();
    if (status && process->is_ready())
      events.push_back(SuccessorBeat{name, status->num_waiting > 0});
    if (const auto ending = process->Reap()) events.push_back(SuccessorExited{name, ending->how});
  }
  for (const Event& event : events) Decide(event);
}

void Session::ListenToUsers() {
  for (const auto& [id, request] : links_.control->Receive()) Take(id, request);
  for (const auto& [id, reply] : orders_.Settle(supervisor_)) links_.control->Answer(id, reply);
}

void Session::Take(ControlSocket::Id id, const ControlRequest& request) {
  using Verb = Asked::Verb;
  static const std::map<std::string, Verb> verbs = {{"start", Verb::kStart},
                                                    {"stop", Verb::kStop},
                                                    {"restart", Verb::kRestart},
                                                    {"swap", Verb::kSwap}};
  if (request.verb() == "status") return links_.control->Answer(id, Report());
  const auto refuse = [&](const std::string& why) {
    ControlReply reply;
    reply.set_code(kRefused);
    reply.set_text(why);
    links_.control->Answer(id, reply);
  };
  const auto verb = verbs.find(request.verb());
  if (verb == verbs.end()) return refuse("this launcher does not know " + request.verb());
  std::vector<std::string> names;
  for (const auto& [name, process] : processes_) {
    if (process->obeys_users()) names.push_back(name);
  }
  const std::string& name = request.module();
  if (std::count(names.begin(), names.end(), name) == 0) {
    return refuse("no module named '" + name + "'" + runtime::Suggestion(name, names));
  }
  if (verb->second == Verb::kSwap) {
    if (supervisor_.state(name) != State::kRunning || supervisor_.is_swapping(name)) {
      return refuse(name + " cannot be swapped now: it " +
                    (supervisor_.is_swapping(name) ? "is being swapped"
                                                   : "is " + NameOf(supervisor_.state(name))));
    }
    try {
      successors_[name] = links_.maker->Make(request);
    } catch (const std::runtime_error& error) {
      return refuse(error.what());
    }
    if (!successors_[name]) {
      successors_.erase(name);
      return refuse(name + " is no module that can be swapped");
    }
  }
  links_.log->Say("asked to " + request.verb() + " " + name);
  orders_.Add(id, verb->second, name, supervisor_);
  Decide(Asked{verb->second, name});
}

ControlReply Session::Report() const {
  ControlReply reply;
  reply.set_code(0);
  reply.set_place(links_.place);
  for (const auto& [name, vitals] : vitals_) {
    ProcessStatus* status = reply.add_process();
    *status = vitals.Report();
    status->set_name(name);
    status->set_state(supervisor_.is_swapping(name) ? "swapping" : NameOf(supervisor_.state(name)));
    status->set_num_restarts(supervisor_.num_restarts(name));
    status->set_uptime_s(MonotonicSeconds() - supervisor_.since_s(name));
  }
  return reply;
}

void Session::Decide(const Event& event) {
  for (const Action& action : supervisor_.Handle(event, MonotonicSeconds())) {
    std::visit([this](const auto& a) { Do(a); }, action);
  }
}

void Session::Do(const Start& action) {
  try {
    processes_.at(action.name)->Start();
  } catch (const std::runtime_error& error) {
    Decide(Exited{action.name, 1, false, error.what()});
  }
}

void Session::Do(const StartSuccessor& action) {
  try {
    successors_.at(action.name)->StartHeld();
  } catch (const std::runtime_error& error) {
    Decide(SuccessorExited{action.name, error.what()});
  }
}

void Session::Do(const Promote& action) {
  auto successor = successors_.extract(action.name);
  std::unique_ptr<Process>& process = processes_.at(action.name);
  successor.mapped()->Release(process->last_utime());
  predecessors_[action.name] = std::exchange(process, std::move(successor.mapped()));
  vitals_[action.name] = {};
}

void Session::Do(const Adopt& action) {
  predecessors_.erase(action.name);
  links_.maker->Adopt(action.name);
}

void Session::Do(const Revert& action) {
  processes_.at(action.name) = std::move(predecessors_.extract(action.name).mapped());
  vitals_[action.name] = {};
}

}  // namespace declutter::launcher
