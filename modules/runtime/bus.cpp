#include "modules/runtime/bus.h"

#include "modules/runtime/shell.h"

namespace declutter::runtime {

void Bus::AddSubscription(std::vector<Port> ports, PartsHandler handler) {
  shell_->AddSubscription(std::move(ports), std::move(handler));
}

std::string Bus::AddOutput(Port port) { return shell_->AddOutput(std::move(port)); }

void Bus::OnStart(std::function<void()> start) { shell_->OnStart(std::move(start)); }

void Bus::Poll(std::function<std::optional<double>()> poll) { shell_->Poll(std::move(poll)); }

bool Bus::lossless() const { return shell_->lossless(); }

void Bus::Warn(const std::string& cause, const std::string& text) { shell_->Warn(cause, text); }

void Bus::Fail(const std::string& text) { shell_->Fail(text); }

void Bus::SetTrouble(const std::string& text) { shell_->SetTrouble(text); }

void Bus::Note(const std::string& text) { shell_->Note(text); }

void Bus::CountSkipped(std::int64_t num_frames) { shell_->CountSkipped(num_frames); }

void Bus::Reject(const std::string& input, const std::string& why) { shell_->Reject(input, why); }

void PublishEncoded(Shell* shell, const std::string& channel, const Bytes& message) {
  shell->Publish(channel, message);
}

}  // namespace declutter::runtime
