#include "launcher/module_process.h"

#include <signal.h>

#include <utility>

namespace declutter::launcher {
namespace {

constexpr int8_t kRunning = 1;  // module_status_t::state

}  // namespace

ModuleProcess::ModuleProcess(std::string name, std::vector<std::string> command,
                             std::string log_path)
    : Program(std::move(command), std::move(log_path)), name_(std::move(name)) {}

void ModuleProcess::Terminate() {
  is_ending_ = true;
  Signal(SIGTERM);
}

void ModuleProcess::OnMessage(const Message& message) {
  auto status = DecodeStatus(message);
  // The number tells it from another of the same name, in a graph run over the same url.
  if (!status || status->module != name_ || status->pid != pid()) return;
  is_ready_ = is_ready_ || status->state == kRunning;
  status_ = std::move(status);
}

std::optional<module_status_t> ModuleProcess::TakeStatus() {
  return std::exchange(status_, std::nullopt);
}

Ending ModuleProcess::Judge(const Ending& ending) const {
  // Until it is ready it may not have its signals in hand yet: then this is how it obeys.
  const bool obeyed = is_ending_ && !is_ready_ && ending.signal == SIGTERM;
  return obeyed ? Ending{} : ending;
}

}  // namespace declutter::launcher
