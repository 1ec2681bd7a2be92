#include "launcher/log_feeder.h"

#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <utility>

#include "modules/runtime/message_layout.h"

namespace declutter::launcher {
namespace {

constexpr double kMinPeriod_s = 0.01;  // a recorder that listens queues no more than 30 messages
constexpr double kResultLimit_s = 3.0;
constexpr int kMaxTries = 5;
constexpr int kFramesPerStatus = 64;  // far less than what waits in a module at most
constexpr size_t kMinMessage = 16;    // fingerprint and utime

}  // namespace

LogFeeder::LogFeeder(const ReplayPlan& plan, Wire* wire)
    : plan_(plan),
      frames_(plan.log, plan.fed, plan.needed, plan.part),
      wire_(wire),
      timer_fd_(timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC)) {
  if (timer_fd_ < 0) throw std::runtime_error("no descriptors left");
  if (!frames_.left_out().empty()) {
    std::cerr << "launcher: " << frames_.left_out() << " and are left out\n";
  }
}

LogFeeder::~LogFeeder() { close(timer_fd_); }

void LogFeeder::OnMessage(const Message& message) {
  if (!frame_ || message.bytes.size() < kMinMessage) return;
  const auto status = DecodeStatus(message);
  const int64_t utime = status ? status->last_utime : runtime::UtimeOf(message.bytes.data());
  if (utime == frame_->utime) missing_.erase(message.channel);
}

void LogFeeder::OnTurn(double now_s) {
  if (!is_started_ || is_ending_) return;
  if (!pace_) Begin(now_s);
  ReadKeys(now_s);
  if (!plan_.speed && !IsSettled(now_s)) return;
  if (!next_) next_ = frames_.Next();
  if (!next_) return EndPass(now_s);
  const double wait_s = DueIn(now_s);
  if (wait_s > 0) return WakeIn(wait_s);
  if (pace_->stands_still()) pace_->StepTo(next_->at_s);
  steps_ = false;
  frame_ = std::exchange(next_, std::nullopt);
  const bool has_status_only = plan_.awaited.count(kModuleStatus.name) > 0;
  const bool is_awaited = !has_status_only || ++num_frames_ % kFramesPerStatus == 0;
  missing_ = is_awaited ? plan_.awaited : std::set<std::string>{};
  num_sent_ = 0;
  Send(now_s);
}

void LogFeeder::ReadKeys(double now_s) {
  const char key = keyboard_.Wait(0.0);
  if (key == ' ') pace_->Toggle(now_s);
  if (key == 'n') steps_ = pace_->stands_still();
}

void LogFeeder::Begin(double now_s) {
  const double speed = plan_.speed.value_or(1.0);
  pace_.emplace(speed, now_s - plan_.part.start_s / speed);
}

// The frame on its way is through or given up.
bool LogFeeder::IsSettled(double now_s) {
  if (!frame_ || missing_.empty()) return true;
  if (now_s - sent_s_ < kResultLimit_s) return false;
  if (num_sent_ < kMaxTries) {
    Send(now_s);
    return false;
  }
  std::cerr << "launcher: frame " << frame_->utime << " us of the log had no result\n";
  missing_.clear();
  code_ = 1;
  return true;
}

double LogFeeder::DueIn(double now_s) const {
  if (pace_->stands_still()) return steps_ ? 0.0 : std::numeric_limits<double>::infinity();
  return plan_.speed ? pace_->Wait(next_->at_s, now_s) : sent_s_ + kMinPeriod_s - now_s;
}

void LogFeeder::EndPass(double now_s) {
  // At a speed the last frame may be on its way, or have been skipped.
  if (!missing_.empty() && now_s - sent_s_ < kResultLimit_s) return;
  if (!frames_.damage().empty()) {
    if (code_ == 0) std::cerr << "launcher: " << frames_.damage() << "\n";
    code_ = 1;
  }
  is_ending_ = !plan_.loops;
  if (is_ending_) return;
  frames_ = LoggedFrames(plan_.log, plan_.fed, plan_.needed, plan_.part);
  Begin(now_s);
}

void LogFeeder::Send(double now_s) {
  for (const Message& message : frame_->messages) wire_->Publish(message);
  sent_s_ = now_s;
  ++num_sent_;
}

// The launcher turns a hundred times a second: too seldom for frames to come evenly.
void LogFeeder::WakeIn(double wait_s) const {
  constexpr double kLongest_s = 1.0;
  const auto wait_ns = static_cast<long>(std::ceil(1e9 * std::min(wait_s, kLongest_s)));
  itimerspec timer = {};
  timer.it_value = {wait_ns / 1'000'000'000, wait_ns % 1'000'000'000};
  timerfd_settime(timer_fd_, 0, &timer, nullptr);
}

std::optional<Ending> LogFeeder::Reap() {
  if (!is_started_ || !is_ending_ || is_reaped_) return std::nullopt;
  is_reaped_ = true;
  return Ending{code_, 0, "exit code " + std::to_string(code_)};
}

}  // namespace declutter::launcher
