#include "launcher/program.h"

#include <signal.h>

#include <utility>

namespace declutter::launcher {

void Program::Start() { Launch({}, false); }

void Program::Launch(const std::vector<std::string>& arguments, bool keeps_stdin) {
  LaunchPlan plan = plan_;
  plan.command.insert(plan.command.end(), arguments.begin(), arguments.end());
  is_ready_ = is_ending_ = false;
  child_ = std::make_unique<ChildProcess>(plan);
  if (!keeps_stdin) child_->Send("");
}

void Program::Send(const std::string& text) {
  if (child_) child_->Send(text);
}

void Program::Kill() { Signal(SIGKILL); }

void Program::Signal(int signal) {
  if (child_) child_->Signal(signal);
}

void Program::OnTurn(double) {
  if (child_) child_->ForwardOutput();
}

std::optional<Ending> Program::Reap() {
  const auto ending = child_ ? child_->Reap() : std::nullopt;
  if (!ending) return ending;
  return Judge(*ending);
}

int Program::fd() const { return child_ ? child_->stderr_fd() : -1; }

}  // namespace declutter::launcher
