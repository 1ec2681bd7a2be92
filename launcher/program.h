#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "launcher/process.h"

namespace declutter::launcher {

// A Process that is a program of its own. What it prints is logged.
class Program : public Process {
 public:
  explicit Program(LaunchPlan plan) : plan_(std::move(plan)) {}

  void Start() override;
  void Kill() override;
  void OnTurn(double now_s) override;
  bool is_ready() const override { return is_ready_; }
  std::optional<Ending> Reap() override;
  int fd() const override;
  pid_t pid() const override { return child_ ? child_->pid() : -1; }

 protected:
  // How its end is to be taken.
  virtual Ending Judge(const Ending& ending) const = 0;

  // Starts with further arguments; keeps_stdin: Send will be called.
  void Launch(const std::vector<std::string>& arguments, bool keeps_stdin);

  void Send(const std::string& text);
  void Signal(int signal);

  bool is_ready_ = false;
  bool is_ending_ = false;  // it was asked to end

 private:
  LaunchPlan plan_;
  std::unique_ptr<ChildProcess> child_;
};

}  // namespace declutter::launcher
