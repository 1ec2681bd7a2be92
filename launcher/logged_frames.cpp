#include "launcher/logged_frames.h"

#include <algorithm>
#include <iterator>
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
                           const std::set<std::string>& needed, const Excerpt& part)
    : path_(path), types_(types), log_(path) {
  CountMessages(needed, part);
  LeaveOutIncomplete();
}

void LoggedFrames::CountMessages(const std::set<std::string>& needed, const Excerpt& part) {
  TimedLog log(path_);
  TypeCheck check(types_);
  std::set<int64_t> elsewhere;
  while (const auto timed = NextEvent(&log)) {
    const std::string& channel = timed->event.channel;
    check.See(timed->event);
    const int64_t utime = runtime::UtimeOf(timed->event.message.data());
    const bool is_known = to_come_.count(utime) > 0;
    if (!is_known && !part.Holds(channel, timed->at_s)) elsewhere.insert(utime);
    if (elsewhere.count(utime) > 0) continue;
    if (!is_known) to_come_[utime].lacking = needed;
    ++to_come_[utime].num_messages;
    to_come_[utime].lacking.erase(channel);
  }
  check.ThrowFault(path_);
  if (!to_come_.empty()) return;
  std::string names;
  for (const auto& [channel, type] : types_) names += " " + channel;
  throw std::runtime_error(path_ + ": no message " + (elsewhere.empty() ? "" : "in that part ") +
                           "on" + names);
}

void LoggedFrames::LeaveOutIncomplete() {
  const size_t num_frames = to_come_.size();
  std::set<std::string> lacking;
  for (auto frame = to_come_.begin(); frame != to_come_.end();) {
    lacking.insert(frame->second.lacking.begin(), frame->second.lacking.end());
    frame = frame->second.lacking.empty() ? std::next(frame) : to_come_.erase(frame);
  }
  if (lacking.empty()) return;
  std::string names;
  for (const std::string& channel : lacking) names += (names.empty() ? "" : " or ") + channel;
  left_out_ = std::to_string(num_frames - to_come_.size()) + " of " + std::to_string(num_frames) +
              " frames of the log have no message on " + names;
  if (to_come_.empty()) throw std::runtime_error(path_ + ": " + left_out_);
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
  while (begun_.empty() || to_come_.at(begun_.front().utime).num_messages > 0) {
    auto timed = NextEvent(&log_);
    if (!timed) return std::nullopt;
    const int64_t utime = runtime::UtimeOf(timed->event.message.data());
    const auto to_come = to_come_.find(utime);
    if (to_come == to_come_.end()) continue;
    --to_come->second.num_messages;
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
