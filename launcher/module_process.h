#pragma once

#include <memory>
#include <string>
#include <vector>

#include "launcher/process.h"

namespace declutter::launcher {

// A module's program. It is ready when it says so in its status.
class ModuleProcess : public Process {
 public:
  // command as for ChildProcess; name as in the graph.
  ModuleProcess(std::string name, std::vector<std::string> command, std::string log_path);

  void Start() override;
  void Terminate() override;
  void Kill() override;
  void OnMessage(const Message& message) override;
  void OnTurn(double now_s) override;
  bool is_ready() const override { return is_ready_; }
  std::optional<Ending> Reap() override;
  int fd() const override;

 private:
  std::string name_;
  std::vector<std::string> command_;
  std::string log_path_;
  std::unique_ptr<ChildProcess> child_;
  bool has_stderr_ = false;
  bool is_ready_ = false;
  bool is_ending_ = false;
};

}  // namespace declutter::launcher
