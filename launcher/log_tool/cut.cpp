#include "launcher/log_tool/cut.h"

#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "launcher/log_tool/log_scan.h"
#include "lcmtypes/channels.h"
#include "modules/runtime/event_log.h"

namespace declutter::log_tool {
namespace {

int CopyTo(runtime::EventLogWriter* writer, const std::string& log,
           const launcher::Excerpt& excerpt) {
  int64_t num_copied = 0;
  const auto damages = ForEachEvent(log, [&](const runtime::LogEvent& event, double at_s) {
    // What made it belongs to every part of a log.
    const bool is_info = event.channel == kRunInfo.name;
    if (!is_info && !excerpt.Holds(event.channel, at_s)) return;
    writer->Write(event);
    num_copied += is_info ? 0 : 1;
  });
  for (const std::string& damage : damages) std::cerr << "log_tool: " << damage << "\n";
  if (num_copied == 0) throw std::runtime_error(log + ": no message in that part");
  return damages.empty() ? 0 : 1;
}

}  // namespace

int Cut(const std::string& log, const std::string& new_log, const launcher::Excerpt& excerpt) {
  runtime::EventLogWriter writer(new_log);
  try {
    return CopyTo(&writer, log, excerpt);
  } catch (const std::runtime_error&) {
    std::error_code ignored;
    std::filesystem::remove(new_log, ignored);  // not the part that was wanted
    throw;
  }
}

}  // namespace declutter::log_tool
