#include "launcher/module_process.h"

#include <limits>
#include <utility>

namespace declutter::launcher {
namespace {

constexpr int8_t kRunning = 1;  // module_status_t::state
constexpr int8_t kFinished = 2;
constexpr double kLastStatusLimit_s = 0.3;

}  // namespace

ModuleProcess::ModuleProcess(std::string name, LaunchPlan plan, int stop_signal)
    : Program(std::move(plan)), name_(std::move(name)), stop_signal_(stop_signal) {}

void ModuleProcess::Start() {
  Forget();
  Program::Start();
  started_pid_ = pid();
}

void ModuleProcess::StartHeld() {
  Forget();
  Launch({"--hold"}, true);
  started_pid_ = pid();
}

void ModuleProcess::Forget() {
  started_pid_ = -1;
  status_.reset();
  last_utime_.reset();
  ending_.reset();
}

void ModuleProcess::Release(std::optional<int64_t> last_utime) {
  Send(std::to_string(last_utime.value_or(std::numeric_limits<int64_t>::max())) + "\n");
}

void ModuleProcess::Terminate() {
  is_ending_ = true;
  Signal(stop_signal_);
}

void ModuleProcess::OnTurn(double now_s) {
  now_s_ = now_s;
  Program::OnTurn(now_s);
}

void ModuleProcess::OnMessage(const Message& message) {
  auto status = DecodeStatus(message);
  // The number tells it from another of the same name, in a graph run over the same url.
  if (!status || status->module != name_ || status->pid != started_pid_) return;
  is_ready_ = is_ready_ || status->state == kRunning;
  if (status->state >= kFinished) last_utime_ = status->last_utime;
  status_ = std::move(status);
}

std::optional<Ending> ModuleProcess::Reap() {
  if (auto ending = Program::Reap()) {
    ending_ = std::move(ending);
    ended_s_ = now_s_;
  }
  if (!ending_) return std::nullopt;
  const bool will_tell = is_ending_ && is_ready_ && ending_->signal == 0 && !last_utime_;
  if (will_tell && now_s_ - ended_s_ < kLastStatusLimit_s) return std::nullopt;
  return std::exchange(ending_, std::nullopt);
}

std::optional<module_status_t> ModuleProcess::TakeStatus() {
  return std::exchange(status_, std::nullopt);
}

Ending ModuleProcess::Judge(const Ending& ending) const {
  // Until it is ready it may not have its signals in hand yet: then this is how it obeys.
  const bool obeyed = is_ending_ && !is_ready_ && ending.signal == stop_signal_;
  return obeyed ? Ending{} : ending;
}

}  // namespace declutter::launcher
