#include "launcher/log_tool/log_scan.h"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "lcmtypes/channels.h"
#include "modules/runtime/message_layout.h"

namespace declutter::log_tool {
namespace {

using runtime::LogEvent;
using runtime::MessageLayout;

// Null for a message of none of our types.
const MessageLayout* LayoutOf(const LogEvent& event) {
  if (event.message.size() < 8) return nullptr;
  const std::int64_t fingerprint = runtime::ReadInteger(event.message.data(), 8);
  for (const MessageLayout& layout : runtime::AllLayouts()) {
    if (layout.fingerprint() == fingerprint) return &layout;
  }
  return nullptr;
}

bool IsWhole(const MessageLayout& layout, const LogEvent& event) {
  try {
    layout.Locate(event.message.data(), event.message.size());
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

void AddTo(const LogEvent& event, ChannelSummary* channel) {
  if (channel->num_messages == 0) channel->first_us = channel->last_us = event.utime;
  const MessageLayout* layout = LayoutOf(event);
  const std::string type = layout == nullptr ? "?" : layout->name();
  if (channel->num_messages > 0 && channel->type != type) channel->type = "several";
  if (channel->num_messages == 0) channel->type = type;
  if (layout != nullptr && !IsWhole(*layout, event)) ++channel->num_damaged;
  ++channel->num_messages;
  channel->num_bytes += static_cast<std::int64_t>(event.message.size());
  channel->max_gap_us = std::max(channel->max_gap_us, event.utime - channel->last_us);
  channel->last_us = event.utime;
}

void TakeInfo(const LogEvent& event, LogSummary* summary) {
  const MessageLayout* layout = LayoutOf(event);
  if (layout == nullptr || layout->name() != run_info_t::getTypeName() ||
      !IsWhole(*layout, event)) {
    return;
  }
  run_info_t info;
  if (info.decode(event.message.data(), 0, static_cast<int>(event.message.size())) < 0) return;
  summary->versions = info.versions;
  summary->graph = info.graph;
}

std::string Line(const std::string& name, const ChannelSummary& channel) {
  const double span_s = static_cast<double>(channel.last_us - channel.first_us) * 1e-6;
  const auto num = static_cast<double>(channel.num_messages);
  char text[256];
  std::snprintf(
      text, sizeof(text), "%-20s %-18s %8lld %8.1f %10.1f %9.3f%s\n", name.c_str(),
      channel.type.c_str(), static_cast<long long>(channel.num_messages),
      span_s > 0 ? (num - 1) / span_s : 0.0, static_cast<double>(channel.num_bytes) / num / 1e3,
      static_cast<double>(channel.max_gap_us) * 1e-6,
      channel.num_damaged > 0 ? (" " + std::to_string(channel.num_damaged) + " damaged").c_str()
                              : "");
  return text;
}

}  // namespace

std::vector<std::string> ForEachEvent(const std::string& path,
                                      const std::function<void(const LogEvent&)>& handle) {
  std::vector<std::string> damages;
  runtime::EventLogReader reader(path);
  for (;;) {
    std::optional<LogEvent> event;
    try {
      event = reader.Next();
    } catch (const std::runtime_error& error) {
      damages.push_back(error.what());
      if (!reader.SkipDamage()) return damages;
      continue;
    }
    if (!event) return damages;
    handle(*event);
  }
}

LogSummary Summarise(const std::string& path) {
  LogSummary summary;
  bool is_first = true;
  summary.damages = ForEachEvent(path, [&](const LogEvent& event) {
    if (is_first) summary.first_us = summary.last_us = event.utime;
    is_first = false;
    if (event.utime < summary.last_us) ++summary.num_backward;
    summary.last_us = event.utime;
    AddTo(event, &summary.channels[event.channel]);
    if (event.channel == kRunInfo.name) TakeInfo(event, &summary);
  });
  return summary;
}

std::string Text(const LogSummary& summary) {
  char head[160];
  std::snprintf(head, sizeof(head), "%.3f s\n\n%-20s %-18s %8s %8s %10s %9s\n",
                static_cast<double>(summary.last_us - summary.first_us) * 1e-6, "channel", "type",
                "messages", "Hz", "mean kB", "max gap s");
  std::string text = head;
  for (const auto& [name, channel] : summary.channels) text += Line(name, channel);
  if (!summary.versions.empty()) text += "\nmade by\n" + summary.versions;
  if (summary.num_backward > 0) {
    text += "\nthe clock went back " + std::to_string(summary.num_backward) + " times\n";
  }
  for (const std::string& damage : summary.damages) text += "\n" + damage;
  return text + (summary.damages.empty() ? "" : "\n");
}

}  // namespace declutter::log_tool
