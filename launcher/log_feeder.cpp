#include "launcher/log_feeder.h"

#include <iostream>

#include "modules/runtime/message_layout.h"

namespace declutter::launcher {
namespace {

constexpr double kMinPeriod_s = 0.01;  // a recorder that listens queues no more than 30 messages
constexpr double kResultLimit_s = 3.0;
constexpr int kMaxTries = 5;
constexpr size_t kMinMessage = 16;  // fingerprint and utime

}  // namespace

LogFeeder::LogFeeder(const ReplayPlan& plan, Wire* wire)
    : awaited_(plan.awaited), frames_(plan.log, plan.fed), wire_(wire) {}

void LogFeeder::OnMessage(const Message& message) {
  if (!frame_ || message.bytes.size() < kMinMessage) return;
  const auto status = DecodeStatus(message);
  const int64_t utime = status ? status->last_utime : runtime::UtimeOf(message.bytes.data());
  if (utime == frame_->utime) missing_.erase(message.channel);
}

void LogFeeder::OnTurn(double now_s) {
  if (!is_started_ || is_ending_) return;
  if (frame_ && !IsThrough()) {
    if (now_s - sent_s_ < kResultLimit_s) return;
    if (num_sent_ < kMaxTries) return Send(now_s);
    std::cerr << "launcher: frame " << frame_->utime << " us of the log had no result\n";
    code_ = 1;
  }
  if (now_s - sent_s_ < kMinPeriod_s) return;
  frame_ = frames_.Next();
  num_sent_ = 0;
  missing_ = awaited_;
  if (frame_) return Send(now_s);
  is_ending_ = true;
  if (frames_.damage().empty()) return;
  std::cerr << "launcher: " << frames_.damage() << "\n";
  code_ = 1;
}

void LogFeeder::Send(double now_s) {
  for (const Message& message : frame_->messages) wire_->Publish(message);
  sent_s_ = now_s;
  ++num_sent_;
}

std::optional<Ending> LogFeeder::Reap() {
  if (!is_started_ || !is_ending_ || is_reaped_) return std::nullopt;
  is_reaped_ = true;
  return Ending{code_, 0, "exit code " + std::to_string(code_)};
}

}  // namespace declutter::launcher
