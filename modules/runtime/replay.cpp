#include "modules/runtime/replay.h"

#include <memory>
#include <set>
#include <stdexcept>

#include "modules/runtime/config_error.h"
#include "modules/runtime/event_log.h"

namespace declutter::runtime {
namespace {

std::string MissingChannels(const Shell& shell, const std::set<std::string>& seen) {
  std::string missing;
  for (const Port& port : shell.inputs()) {
    if (seen.count(port.channel) == 0) missing += (missing.empty() ? "" : ", ") + port.channel;
  }
  return missing;
}

void CheckSomethingHandled(const std::string& in, const Shell& shell,
                           const std::set<std::string>& seen) {
  if (shell.num_handled() > 0) return;
  const std::string missing = MissingChannels(shell, seen);
  throw std::runtime_error(in + ": holds no frame for this module" +
                           (missing.empty() ? "" : "; there is nothing on " + missing));
}

}  // namespace

void Replay(const std::string& in, const std::string& out, Shell* shell) {
  if (shell->is_source() || shell->inputs().empty()) {
    throw ConfigError("--replay: a source has nothing to be replayed from a log");
  }
  EventLogReader reader(in);
  std::unique_ptr<EventLogWriter> writer;
  if (!out.empty()) writer = std::make_unique<EventLogWriter>(out);
  std::int64_t event_utime = 0;
  shell->Connect([&writer, &event_utime](const std::string& channel, const Bytes& message) {
    if (writer) writer->Write({event_utime, channel, message});
  });
  shell->Start();
  std::set<std::string> seen;
  while (const std::optional<LogEvent> event = reader.Next()) {
    event_utime = event->utime;
    seen.insert(event->channel);
    shell->Receive(event->channel, event->message.data(), event->message.size());
    shell->HandleWaiting();
  }
  CheckSomethingHandled(in, *shell, seen);
}

}  // namespace declutter::runtime
