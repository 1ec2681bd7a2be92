#include "launcher/recorder.h"

#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "modules/runtime/event_log.h"

namespace declutter::launcher {
namespace {

constexpr int kPriority = -10;
constexpr double kMarkPeriod_s = 0.2;
constexpr std::streamoff kTail = 1 << 20;  // [byte] of the log in which the mark is searched
constexpr int8_t kStarting = 0;            // module_status_t::state
constexpr int8_t kFinished = 2;

bool TailHolds(const std::string& path, const std::vector<uint8_t>& mark) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file.tellg();
  if (!file || mark.empty()) return false;
  const std::streamoff begin = std::max<std::streamoff>(0, size - kTail);
  std::vector<uint8_t> tail(static_cast<size_t>(size - begin));
  file.seekg(begin);
  file.read(reinterpret_cast<char*>(tail.data()), static_cast<std::streamsize>(tail.size()));
  return std::search(tail.begin(), tail.end(), mark.begin(), mark.end()) != tail.end();
}

// Status and LCM's own are sent at any time, also outside the run.
bool IsCounted(const std::string& channel) {
  return channel != kModuleStatus.name && channel != "LCM_SELF_TEST";
}

int64_t WallClock_us() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

}  // namespace

Recorder::Recorder(LaunchPlan plan, std::string log, Wire* wire)
    : Program(std::move(plan)), log_(std::move(log)), wire_(wire) {}

void Recorder::Start() {
  Program::Start();
  // Late, it loses messages: it goes first where we may say so.
  setpriority(PRIO_PROCESS, static_cast<id_t>(pid()), kPriority);
}

void Recorder::Terminate() {
  if (!is_ready_) return Kill();
  is_ending_ = true;
  mark_ = {};
  mark_s_ = 0.0;
}

void Recorder::OnMessage(const Message& message) {
  if (is_ready_ && IsCounted(message.channel)) ++num_heard_;
}

void Recorder::OnTurn(double now_s) {
  Program::OnTurn(now_s);
  if (pid() < 0 || is_complete_ || (is_ready_ && !is_ending_)) return;
  if (!TailHolds(log_, mark_.bytes)) {
    if (now_s - mark_s_ > kMarkPeriod_s) SendMark(now_s);
    return;
  }
  is_ready_ = true;
  if (!is_ending_) return;
  is_complete_ = true;
  Signal(SIGTERM);
}

void Recorder::SendMark(double now_s) {
  if (mark_.bytes.empty()) {
    module_status_t status = {};
    status.utime = WallClock_us();
    status.module = status.program = "launcher";
    status.pid = ::getpid();
    status.state = is_ending_ ? kFinished : kStarting;
    mark_ = EncodeStatus(status);
  }
  mark_s_ = now_s;
  wire_->Publish(mark_);
}

Ending Recorder::Judge(const Ending& ending) const {
  if (ending.code != 0) return ending;
  if (!is_complete_) return {1, 0, "an incomplete log " + log_};
  int64_t num_recorded = 0;
  try {
    runtime::EventLogReader reader(log_);
    while (const auto event = reader.Next()) num_recorded += IsCounted(event->channel) ? 1 : 0;
  } catch (const std::runtime_error& error) {
    return {1, 0, error.what()};
  }
  if (num_recorded >= num_heard_) return {};
  return {1, 0,
          "a log that lacks " + std::to_string(num_heard_ - num_recorded) + " of " +
              std::to_string(num_heard_) + " messages"};
}

}  // namespace declutter::launcher
