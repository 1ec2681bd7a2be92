#include "launcher/status_table.h"

#include <algorithm>
#include <cstdio>

namespace declutter::launcher {
namespace {

std::string Duration(double seconds) {
  const int total = static_cast<int>(std::min(seconds, 1e8));
  char text[32];
  std::snprintf(text, sizeof(text), "%d:%02d:%02d", total / 3600, total / 60 % 60, total % 60);
  return text;
}

std::string Line(const ProcessStatus& p, int width) {
  char text[320];
  std::snprintf(text, sizeof(text),
                "%-*s %-8s %7d %8d %9s %5.0f%% %7.0f %9lld %9lld %8lld %8lld %6.1f %7.1f %7.1f\n",
                width, p.name().c_str(), p.state().c_str(), p.pid(), p.num_restarts(),
                Duration(p.uptime_s()).c_str(), 100.0 * p.load(), p.memory_mb(),
                static_cast<long long>(p.num_in()), static_cast<long long>(p.num_out()),
                static_cast<long long>(p.num_skipped()), static_cast<long long>(p.num_rejected()),
                p.rate_hz(), p.processing_ms(), p.max_processing_ms());
  return text;
}

}  // namespace

std::string StatusTable(const ControlReply& reply) {
  size_t width = 7;
  for (const ProcessStatus& process : reply.process()) {
    width = std::max(width, process.name().size());
  }
  char head[320];
  std::snprintf(head, sizeof(head), "%-*s %-8s %7s %8s %9s %6s %7s %9s %9s %8s %8s %6s %7s %7s\n",
                static_cast<int>(width), "process", "state", "pid", "restarts", "for", "cpu", "MB",
                "in", "out", "skipped", "rejected", "Hz", "ms", "max ms");
  std::string text = head;
  for (const ProcessStatus& process : reply.process()) {
    text += Line(process, static_cast<int>(width));
  }
  for (const ProcessStatus& process : reply.process()) {
    if (!process.message().empty()) text += process.name() + ": " + process.message() + "\n";
  }
  return text;
}

}  // namespace declutter::launcher
