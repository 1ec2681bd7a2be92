#include "launcher/log_tool/frame_summary.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <utility>

#include "launcher/log_tool/log_scan.h"
#include "launcher/wire.h"
#include "modules/runtime/message_layout.h"

namespace declutter::log_tool {
namespace {

using runtime::LogEvent;

constexpr size_t kMinSize = 16;           // [byte] fingerprint and utime
constexpr char kLauncher[] = "launcher";  // its statuses mark the ends of a log

class FrameLedger {
 public:
  void Add(const LogEvent& event, double at_s) {
    if (event.message.size() < kMinSize) return;
    if (event.channel == kModuleStatus.name) return AddStatus(event);
    if (event.channel == kRunInfo.name) return;
    ++summary_.num_logged;
    const int64_t at_us = std::llround(1e6 * at_s);
    const int64_t utime = runtime::UtimeOf(event.message.data());
    if (event.channel == kDepthFrame.name) {
      if (sent_us_.emplace(utime, at_us).second) Extend(at_us);
      return;
    }
    // Colour goes out before its depth; what is there before has no delay.
    const auto sent = sent_us_.find(utime);
    if (sent == sent_us_.end() || !seen_[event.channel].insert(utime).second) return;
    summary_.delays_ms[event.channel].push_back(1e-3 * static_cast<double>(at_us - sent->second));
  }

  FrameSummary Finish() {
    for (auto& [channel, delays_ms] : summary_.delays_ms) {
      std::sort(delays_ms.begin(), delays_ms.end());
    }
    for (const auto& [process, num] : published_) summary_.num_published += num;
    return std::move(summary_);
  }

 private:
  void Extend(int64_t record_us) {
    if (summary_.num_frames++ == 0) first_us_ = record_us;
    summary_.span_s = 1e-6 * static_cast<double>(record_us - first_us_);
  }

  void AddStatus(const LogEvent& event) {
    const auto status = launcher::DecodeStatus({event.channel, event.message});
    if (!status || status->module == kLauncher) return;
    summary_.modules[status->module] = *status;
    published_[{status->module, status->pid}] = status->num_messages;
  }

  FrameSummary summary_;
  int64_t first_us_ = 0;
  std::map<int64_t, int64_t> sent_us_;  // by utime
  std::map<std::string, std::set<int64_t>> seen_;
  std::map<std::pair<std::string, int32_t>, int64_t> published_;  // by module and process
};

}  // namespace

FrameSummary SummariseFrames(const std::string& log) {
  FrameLedger ledger;
  std::vector<std::string> damages =
      ForEachEvent(log, [&](const LogEvent& event, double at_s) { ledger.Add(event, at_s); });
  FrameSummary summary = ledger.Finish();
  summary.damages = std::move(damages);
  return summary;
}

double Percentile(const std::vector<double>& ascending, double p) {
  const auto rank = static_cast<size_t>(std::ceil(p * static_cast<double>(ascending.size())));
  return ascending[std::max<size_t>(rank, 1) - 1];
}

std::string Text(const FrameSummary& summary) {
  char line[256];
  std::snprintf(line, sizeof(line), "%lld depth frames in %.3f s\n\n%-20s %8s %8s %8s\n",
                static_cast<long long>(summary.num_frames), summary.span_s, "module", "in", "out",
                "skipped");
  std::string text = line;
  for (const auto& [name, status] : summary.modules) {
    std::snprintf(line, sizeof(line), "%-20s %8lld %8lld %8lld\n", name.c_str(),
                  static_cast<long long>(status.num_in), static_cast<long long>(status.num_out),
                  static_cast<long long>(status.num_skipped));
    text += line;
  }
  std::snprintf(line, sizeof(line), "\n%lld messages published by modules, %lld in the log\n",
                static_cast<long long>(summary.num_published),
                static_cast<long long>(summary.num_logged));
  text += line;
  std::snprintf(line, sizeof(line), "\n%-20s %8s %8s %8s %8s %8s\n", "ms after its depth", "frames",
                "p50", "p95", "p99", "max");
  text += line;
  for (const auto& [channel, delays_ms] : summary.delays_ms) {
    std::snprintf(line, sizeof(line), "%-20s %8zu %8.1f %8.1f %8.1f %8.1f\n", channel.c_str(),
                  delays_ms.size(), Percentile(delays_ms, 0.5), Percentile(delays_ms, 0.95),
                  Percentile(delays_ms, 0.99), delays_ms.back());
    text += line;
  }
  for (const std::string& damage : summary.damages) text += "\n" + damage + "\n";
  return text;
}

}  // namespace declutter::log_tool
