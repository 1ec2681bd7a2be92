#pragma once

#include <string>
#include <vector>

#include "launcher/program.h"

namespace declutter::launcher {

// A module's program. It is ready when it says so in its status.
class ModuleProcess : public Program {
 public:
  // command as for ChildProcess; name as in the graph.
  ModuleProcess(std::string name, std::vector<std::string> command, std::string log_path);

  void Terminate() override;
  void OnMessage(const Message& message) override;
  std::optional<module_status_t> TakeStatus() override;

 protected:
  Ending Judge(const Ending& ending) const override;

 private:
  std::string name_;
  std::optional<module_status_t> status_;
};

}  // namespace declutter::launcher
