#include "launcher/module_process.h"

#include <signal.h>

#include <utility>

namespace declutter::launcher {
namespace {

constexpr int8_t kRunning = 1;  // module_status_t::state

}  // namespace

ModuleProcess::ModuleProcess(std::string name, std::vector<std::string> command,
                             std::string log_path)
    : name_(std::move(name)), command_(std::move(command)), log_path_(std::move(log_path)) {}

void ModuleProcess::Start() {
  child_ = std::make_unique<ChildProcess>(command_, log_path_);
  has_stderr_ = true;
}

void ModuleProcess::Terminate() {
  is_ending_ = true;
  if (child_) child_->Signal(SIGTERM);
}

void ModuleProcess::Kill() {
  if (child_) child_->Signal(SIGKILL);
}

void ModuleProcess::OnMessage(const Message& message) {
  if (is_ready_ || !child_) return;
  const auto status = DecodeStatus(message);
  // The number tells it from another of the same name, in a graph run over the same url.
  is_ready_ = status && status->module == name_ && status->pid == child_->pid() &&
              status->state == kRunning;
}

void ModuleProcess::OnTurn(double) {
  if (has_stderr_) has_stderr_ = child_->ForwardStderr();
}

std::optional<Ending> ModuleProcess::Reap() {
  auto ending = child_ ? child_->Reap() : std::nullopt;
  if (!ending) return ending;
  has_stderr_ = false;
  // Until it is ready it may not have its signals in hand yet: then this is how it obeys.
  const bool obeyed = is_ending_ && !is_ready_ && ending->signal == SIGTERM;
  return obeyed ? Ending{} : ending;
}

int ModuleProcess::fd() const { return has_stderr_ ? child_->stderr_fd() : -1; }

}  // namespace declutter::launcher
