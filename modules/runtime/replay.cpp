#include "modules/runtime/replay.h"

#include <map>
#include <memory>
#include <set>
#include <stdexcept>

#include "modules/runtime/config_error.h"
#include "modules/runtime/event_log.h"
#include "modules/runtime/message_layout.h"

namespace declutter::runtime {
namespace {

std::string MissingChannels(const Shell& shell, const std::set<std::string>& seen) {
  std::string missing;
  for (const Port& port : shell.inputs()) {
    if (seen.count(port.channel) == 0) missing += (missing.empty() ? "" : ", ") + port.channel;
  }
  return missing;
}

// When there are messages for the module, by channel.
std::map<std::string, std::set<std::int64_t>> UtimesOf(const std::string& in, const Shell& shell) {
  constexpr std::size_t kMinMessage = 16;  // fingerprint and utime
  std::map<std::string, std::set<std::int64_t>> utimes;
  for (const Port& port : shell.inputs()) utimes[port.channel];
  EventLogReader reader(in);
  try {
    while (const std::optional<LogEvent> event = reader.Next()) {
      const auto channel = utimes.find(event->channel);
      if (channel == utimes.end() || event->message.size() < kMinMessage) continue;
      channel->second.insert(UtimeOf(event->message.data()));
    }
  } catch (const std::runtime_error&) {  // the reading that counts will meet it again
  }
  return utimes;
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
  shell->ExpectOnly(UtimesOf(in, *shell));
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
  if (const std::int64_t num = shell->num_left_out(); num > 0) {
    shell->Note(in + ": " + std::to_string(num) +
                " messages of frames that lack another were left out");
  }
}

}  // namespace declutter::runtime
