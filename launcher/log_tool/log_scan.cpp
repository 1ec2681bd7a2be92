#include "launcher/log_tool/log_scan.h"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <optional>
#include <stdexcept>

#include "launcher/timed_log.h"
#include "lcmtypes/channels.h"
#include "modules/runtime/message_layout.h"

namespace declutter::log_tool {
namespace {

using runtime::FindLayout;
using runtime::LogEvent;
using runtime::MessageLayout;

bool IsWhole(const MessageLayout& layout, const LogEvent& event) {
  try {
    layout.Locate(event.message.data(), event.message.size());
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

// FNV-1a, 64 bit: equal for the same messages, also on another machine.
void AddTo(const runtime::Bytes& message, uint64_t* hash) {
  constexpr uint64_t kPrime = 0x100000001b3;
  for (const uint8_t byte : message) *hash = (*hash ^ byte) * kPrime;
}

void AddTo(const LogEvent& event, double at_s, ChannelSummary* channel) {
  constexpr uint64_t kHashOfNothing = 0xcbf29ce484222325;
  const MessageLayout* layout = FindLayout(event.message.data(), event.message.size());
  const std::string type = layout == nullptr ? "?" : layout->name();
  if (channel->num_messages == 0) {
    channel->first_s = channel->last_s = at_s;
    channel->hash = kHashOfNothing;
    channel->type = type;
  }
  if (channel->type != type) channel->type = "several";
  if (layout != nullptr && !IsWhole(*layout, event)) ++channel->num_damaged;
  ++channel->num_messages;
  channel->num_bytes += static_cast<std::int64_t>(event.message.size());
  channel->max_gap_s = std::max(channel->max_gap_s, at_s - channel->last_s);
  channel->last_s = at_s;
  AddTo(event.message, &channel->hash);
}

void TakeInfo(const LogEvent& event, LogSummary* summary) {
  const MessageLayout* layout = FindLayout(event.message.data(), event.message.size());
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
  const double span_s = channel.last_s - channel.first_s;
  const auto num = static_cast<double>(channel.num_messages);
  char text[256];
  const std::string damage =
      channel.num_damaged > 0 ? " " + std::to_string(channel.num_damaged) + " damaged" : "";
  std::snprintf(text, sizeof(text), "%-20s %-18s %8lld %8.1f %10.1f %9.3f  %016" PRIx64 "%s\n",
                name.c_str(), channel.type.c_str(), static_cast<long long>(channel.num_messages),
                span_s > 0 ? (num - 1) / span_s : 0.0,
                static_cast<double>(channel.num_bytes) / num / 1e3, channel.max_gap_s, channel.hash,
                damage.c_str());
  return text;
}

}  // namespace

std::vector<std::string> ForEachEvent(
    const std::string& path, const std::function<void(const LogEvent&, double at_s)>& handle) {
  return ForEachEventWhile(path, [&](const LogEvent& event, double at_s) {
    handle(event, at_s);
    return true;
  });
}

std::vector<std::string> ForEachEventWhile(
    const std::string& path, const std::function<bool(const LogEvent&, double at_s)>& handle) {
  std::vector<std::string> damages;
  launcher::TimedLog log(path);
  for (;;) {
    std::optional<launcher::TimedEvent> timed;
    try {
      timed = log.Next();
    } catch (const std::runtime_error& error) {
      damages.push_back(error.what());
      if (!log.SkipDamage()) return damages;
      continue;
    }
    if (!timed || !handle(timed->event, timed->at_s)) return damages;
  }
}

LogSummary Summarise(const std::string& path) {
  LogSummary summary;
  std::optional<int64_t> last_us;
  summary.damages = ForEachEvent(path, [&](const LogEvent& event, double at_s) {
    if (last_us && event.utime < *last_us) ++summary.num_backward;
    last_us = event.utime;
    summary.span_s = at_s;
    AddTo(event, at_s, &summary.channels[event.channel]);
    if (event.channel == kRunInfo.name) TakeInfo(event, &summary);
  });
  return summary;
}

std::string Text(const LogSummary& summary) {
  char head[160];
  std::snprintf(head, sizeof(head), "%.3f s\n\n%-20s %-18s %8s %8s %10s %9s  %s\n", summary.span_s,
                "channel", "type", "messages", "Hz", "mean kB", "max gap s", "hash of all");
  std::string text = head;
  for (const auto& [name, channel] : summary.channels) text += Line(name, channel);
  for (const auto& [name, channel] : summary.channels) {
    if (channel.type != "?" || name == "LCM_SELF_TEST") continue;
    text += "\n? is no type of this version\n";
    break;
  }
  if (!summary.versions.empty()) text += "\nmade by\n" + summary.versions;
  if (summary.num_backward > 0) {
    text += "\nthe clock went back " + std::to_string(summary.num_backward) + " times\n";
  }
  for (const std::string& damage : summary.damages) text += "\n" + damage;
  return text + (summary.damages.empty() ? "" : "\n");
}

}  // namespace declutter::log_tool
