#include "launcher/log_tool/channel_monitor.h"

#include <cstdio>
#include <iterator>

#include "launcher/log_tool/message_text.h"
#include "modules/runtime/message_layout.h"

namespace declutter::log_tool {
namespace {

constexpr double kWindow_s = 2.0;

}  // namespace

void ChannelMonitor::Add(const launcher::Message& message, double at_s) {
  Traffic& traffic = channels_[message.channel];
  ++traffic.num_messages;
  traffic.recent.emplace_back(at_s, message.bytes.size());
  while (traffic.recent.front().first <= at_s - kWindow_s) traffic.recent.pop_front();
  traffic.latest = message;
  traffic.latest_s = at_s;
  const bool is_ours = runtime::FindLayout(message.bytes.data(), message.bytes.size()) != nullptr;
  if (chosen_.empty() && is_ours) chosen_ = message.channel;
}

std::vector<std::string> ChannelMonitor::Lines(double now_s) const {
  char head[120];
  std::snprintf(head, sizeof head, "  %-17s %-17s %8s %6s %8s %7s %6s", "channel", "type",
                "messages", "Hz", "kB/s", "kB", "age s");
  std::vector<std::string> lines = {head};
  for (const auto& [channel, traffic] : channels_) lines.push_back(Line(channel, traffic, now_s));
  const auto chosen = channels_.find(chosen_);
  if (chosen == channels_.end()) return lines;
  lines.insert(lines.end(), {"", chosen_});
  for (const std::string& field : FieldLines(chosen->second.latest.bytes)) {
    lines.push_back("  " + field);
  }
  return lines;
}

std::string ChannelMonitor::Line(const std::string& channel, const Traffic& traffic,
                                 double now_s) const {
  size_t num = 0, num_bytes = 0;
  for (const auto& [at_s, size] : traffic.recent) {
    if (at_s <= now_s - kWindow_s) continue;
    ++num;
    num_bytes += size;
  }
  const runtime::Bytes& latest = traffic.latest.bytes;
  const auto* layout = runtime::FindLayout(latest.data(), latest.size());
  char text[200];
  std::snprintf(text, sizeof text, "%c %-17s %-17s %8lld %6.1f %8.1f %7.1f %6.1f",
                channel == chosen_ ? '>' : ' ', channel.c_str(),
                layout == nullptr ? "?" : layout->name().c_str(),
                static_cast<long long>(traffic.num_messages), static_cast<double>(num) / kWindow_s,
                1e-3 * static_cast<double>(num_bytes) / kWindow_s,
                1e-3 * static_cast<double>(latest.size()), now_s - traffic.latest_s);
  return text;
}

void ChannelMonitor::Choose(int step) {
  if (channels_.empty()) return;
  auto chosen = channels_.find(chosen_);
  if (chosen == channels_.end()) chosen = channels_.begin();
  for (; step > 0 && std::next(chosen) != channels_.end(); --step) ++chosen;
  for (; step < 0 && chosen != channels_.begin(); ++step) --chosen;
  chosen_ = chosen->first;
}

}  // namespace declutter::log_tool
