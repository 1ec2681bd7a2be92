#include "launcher/logged_frames.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "modules/runtime/message_layout.h"

namespace declutter::launcher {
namespace {

constexpr size_t kMinMessage = 16;  // fingerprint and utime

void AddMessage(runtime::LogEvent event, LoggedFrame* frame) {
  auto& messages = frame->messages;
  const auto same = std::find_if(messages.begin(), messages.end(), [&](const Message& message) {
    return message.channel == event.channel;
  });
  if (same == messages.end()) messages.push_back({event.channel, std::move(event.message)});
}

}  // namespace

LoggedFrames::LoggedFrames(const std::string& path, const std::set<std::string>& channels)
    : channels_(channels), reader_(path) {
  runtime::EventLogReader reader(path);
  while (const auto event = NextEvent(&reader)) {
    ++num_to_come_[runtime::UtimeOf(event->message.data())];
  }
  if (!num_to_come_.empty()) return;
  std::string names;
  for (const std::string& channel : channels) names += " " + channel;
  throw std::runtime_error(path + ": no message on" + names);
}

std::optional<runtime::LogEvent> LoggedFrames::NextEvent(runtime::EventLogReader* reader) {
  try {
    while (auto event = reader->Next()) {
      if (channels_.count(event->channel) == 0 || event->message.size() < kMinMessage) continue;
      return event;
    }
  } catch (const std::runtime_error& error) {
    damage_ = error.what();
  }
  return std::nullopt;
}

std::optional<LoggedFrame> LoggedFrames::Next() {
  while (begun_.empty() || num_to_come_.at(begun_.front().utime) > 0) {
    auto event = NextEvent(&reader_);
    if (!event) return std::nullopt;
    const int64_t utime = runtime::UtimeOf(event->message.data());
    --num_to_come_.at(utime);
    auto frame = std::find_if(begun_.begin(), begun_.end(),
                              [&](const LoggedFrame& begun) { return begun.utime == utime; });
    if (frame == begun_.end()) frame = begun_.insert(frame, {utime, {}});
    AddMessage(std::move(*event), &*frame);
  }
  LoggedFrame frame = std::move(begun_.front());
  begun_.pop_front();
  return frame;
}

}  // namespace declutter::launcher
