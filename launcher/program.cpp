#include "launcher/program.h"

#include <signal.h>

#include <utility>

namespace declutter::launcher {

Program::Program(std::vector<std::string> command, std::string log_path)
    : command_(std::move(command)), log_path_(std::move(log_path)) {}

void Program::Start() { Launch({}, false); }

void Program::Launch(const std::vector<std::string>& arguments, bool keeps_stdin) {
  std::vector<std::string> command = command_;
  command.insert(command.end(), arguments.begin(), arguments.end());
  is_ready_ = is_ending_ = false;
  child_ = std::make_unique<ChildProcess>(command, log_path_);
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
