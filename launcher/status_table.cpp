#include "launcher/status_table.h"

#include <algorithm>
#include <cstdio>
#include <vector>

namespace declutter::launcher {
namespace {

using Row = std::vector<std::string>;

const Row kHead = {"process", "state",   "pid",      "restarts", "for", "cpu", "MB",      "in",
                   "out",     "skipped", "rejected", "Hz",       "ms",  "max", "latency", "max"};

std::string Duration(double seconds) {
  const int total = static_cast<int>(std::min(seconds, 1e8));
  char text[32];
  std::snprintf(text, sizeof(text), "%d:%02d:%02d", total / 3600, total / 60 % 60, total % 60);
  return text;
}

std::string Number(double value, int num_digits, const char* unit = "") {
  char text[64];
  std::snprintf(text, sizeof(text), "%.*f%s", num_digits, value, unit);
  return text;
}

// 0: no frame was finished lately.
std::string Milliseconds(double value) { return value > 0 ? Number(value, 1) : "-"; }

Row RowOf(const ProcessStatus& p) {
  Row row = {p.name(),
             p.state(),
             p.pid() > 0 ? std::to_string(p.pid()) : "-",
             std::to_string(p.num_restarts()),
             Duration(p.uptime_s()),
             Number(100.0 * p.load(), 0, "%"),
             Number(p.memory_mb(), 0)};
  if (!p.has_num_in()) {
    row.resize(kHead.size(), "-");
    return row;
  }
  for (const int64_t count : {p.num_in(), p.num_out(), p.num_skipped(), p.num_rejected()}) {
    row.push_back(std::to_string(count));
  }
  row.push_back(Number(p.rate_hz(), 1));
  for (const double ms :
       {p.processing_ms(), p.max_processing_ms(), p.latency_ms(), p.max_latency_ms()}) {
    row.push_back(Milliseconds(ms));
  }
  return row;
}

// Names begin on the left, numbers end on the right.
std::string Aligned(const std::vector<Row>& rows) {
  constexpr size_t kNumNames = 2;
  std::vector<size_t> widths(kHead.size());
  for (const Row& row : rows) {
    for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const Row& row : rows) {
    for (size_t i = 0; i < row.size(); ++i) {
      const std::string space(widths[i] - row[i].size(), ' ');
      text += (i > 0 ? "  " : "") + (i < kNumNames ? row[i] + space : space + row[i]);
    }
    text += '\n';
  }
  return text;
}

}  // namespace

std::string StatusTable(const ControlReply& reply) {
  std::vector<Row> rows = {kHead};
  for (const ProcessStatus& process : reply.process()) rows.push_back(RowOf(process));
  std::string text = Aligned(rows);
  for (const ProcessStatus& process : reply.process()) {
    if (!process.message().empty()) text += process.name() + ": " + process.message() + "\n";
  }
  return text + reply.place() + "\n";
}

}  // namespace declutter::launcher
