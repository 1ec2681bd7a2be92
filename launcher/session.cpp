#include "launcher/session.h"

#include <poll.h>
#include <signal.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <chrono>
#include <iostream>
#include <stdexcept>
#include <utility>

namespace declutter::launcher {
namespace {

constexpr int kTurn_ms = 10;

double MonotonicSeconds() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

sigset_t HandledSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) sigaddset(&signals, signal);
  return signals;
}

Beat BeatOf(const std::string& name, const module_status_t& status) {
  return {name, status.num_done, status.num_waiting > 0 || status.num_in > status.num_done};
}

}  // namespace

void HoldSignals() {
  const sigset_t signals = HandledSignals();
  sigprocmask(SIG_BLOCK, &signals, nullptr);
  signal(SIGPIPE, SIG_IGN);  // whoever reads our stderr may leave; the run goes on
}

Session::Session(Supervisor supervisor, std::map<std::string, std::unique_ptr<Process>> processes,
                 Wire* wire)
    : supervisor_(std::move(supervisor)), processes_(std::move(processes)), wire_(wire) {
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
    const std::vector<Message> messages = wire_->Receive();
    for (auto& [name, process] : processes_) {
      for (const Message& message : messages) process->OnMessage(message);
      process->OnTurn(MonotonicSeconds());
      if (process->is_ready()) Decide(Ready{name});
      if (const auto status = process->TakeStatus()) Decide(BeatOf(name, *status));
      if (const auto ending = process->Reap()) {
        Decide(Exited{name, ending->code, ending->signal != 0, ending->how});
      }
    }
    Decide(TimePassed{});
  }
  return supervisor_.exit_code();
}

void Session::Wait() {
  std::vector<pollfd> waited = {{signal_fd_, POLLIN, 0}, {wire_->fd(), POLLIN, 0}};
  for (const auto& [name, process] : processes_) waited.push_back({process->fd(), POLLIN, 0});
  poll(waited.data(), waited.size(), kTurn_ms);
}

void Session::ReadSignals() {
  signalfd_siginfo signal;
  while (read(signal_fd_, &signal, sizeof(signal)) == sizeof(signal)) {
    if (signal.ssi_signo == SIGCHLD) continue;  // has only ended the wait
    Decide(Interrupted{static_cast<int>(signal.ssi_signo)});
  }
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

void Session::Do(const Say& action) { std::cerr << "launcher: " << action.text << std::endl; }

}  // namespace declutter::launcher
