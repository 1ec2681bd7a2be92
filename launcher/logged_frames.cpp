#include "launcher/logged_frames.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

#include "modules/runtime/message_layout.h"

namespace declutter::launcher {
namespace {

using runtime::MessageLayout;

constexpr size_t kMinMessage = 16;  // fingerprint and utime

// Finds channels of which no message is of the type that is needed: no module could use them.
class TypeCheck {
 public:
  explicit TypeCheck(const std::map<std::string, std::string>& types) {
    for (const MessageLayout& layout : runtime::AllLayouts()) {
      for (const auto& [channel, type] : types) {
        if (type == layout.name()) layouts_[channel] = &layout;
      }
    }
  }

  void See(const runtime::LogEvent& event) {
    const auto layout = layouts_.find(event.channel);
    if (layout == layouts_.end()) return;
    try {
      layout->second->CheckType(event.message.data(), event.message.size());
      faults_[event.channel].clear();
      layouts_.erase(layout);
    } catch (const std::runtime_error& error) {
      faults_[event.channel] = error.what();
    }
  }

  void ThrowFault(const std::string& log) const {
    for (const auto& [channel, fault] : faults_) {
      if (!fault.empty()) throw std::runtime_error(log + ": on " + channel + " is " + fault);
    }
  }

 private:
  std::map<std::string, const MessageLayout*> layouts_;  // of channels whose type was not met yet
  std::map<std::string, std::string> faults_;            // by channel
};

void AddMessage(runtime::LogEvent event, LoggedFrame* frame) {
  auto& messages = frame->messages;
  const auto same = std::find_if(messages.begin(), messages.end(), [&](const Message& message) {
    return message.channel == event.channel;
  });
  if (same == messages.end()) messages.push_back({event.channel, std::move(event.message)});
}

}  // namespace

LoggedFrames::LoggedFrames(const std::string& path, const std::map<std::string, std::string>& types,
                           const Excerpt& part)
    : path_(path), types_(types), log_(path) {
  CountMessages(part);
}

void LoggedFrames::CountMessages(const Excerpt& part) {
  TimedLog log(path_);
  TypeCheck check(types_);
  std::set<int64_t> left_out;
  while (const auto timed = NextEvent(&log)) {
    check.See(timed->event);
    const int64_t utime = runtime::UtimeOf(timed->event.message.data());
    const bool is_known = num_to_come_.count(utime) > 0;
    if (!is_known && !part.Holds(timed->event.channel, timed->at_s)) left_out.insert(utime);
    if (left_out.count(utime) == 0) ++num_to_come_[utime];
  }
  check.ThrowFault(path_);
  if (!num_to_come_.empty()) return;
  std::string names;
  for (const auto& [channel, type] : types_) names += " " + channel;
  throw std::runtime_error(path_ + ": no message " + (left_out.empty() ? "" : "in that part ") +
                           "on" + names);
}

std::optional<TimedEvent> LoggedFrames::NextEvent(TimedLog* log) {
  try {
    while (auto timed = log->Next()) {
      const bool is_wanted = types_.count(timed->event.channel) > 0;
      if (is_wanted && timed->event.message.size() >= kMinMessage) return timed;
    }
  } catch (const std::runtime_error& error) {
    damage_ = error.what();
  }
  return std::nullopt;
}

std::optional<LoggedFrame> LoggedFrames::Next() {
  while (begun_.empty() || num_to_come_.at(begun_.front().utime) > 0) {
    auto timed = NextEvent(&log_);
    if (!timed) return std::nullopt;
    const int64_t utime = runtime::UtimeOf(timed->event.message.data());
    const auto to_come = num_to_come_.find(utime);
    if (to_come == num_to_come_.end()) continue;
    --to_come->second;
    auto frame = std::find_if(begun_.begin(), begun_.end(),
                              [&](const LoggedFrame& begun) { return begun.utime == utime; });
    if (frame == begun_.end()) frame = begun_.insert(frame, {utime, 0.0, {}});
    frame->at_s = timed->at_s;
    AddMessage(std::move(timed->event), &*frame);
  }
  LoggedFrame frame = std::move(begun_.front());
  begun_.pop_front();
  return frame;
}

}  // namespace declutter::launcher
