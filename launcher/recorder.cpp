#include "launcher/recorder.h"

#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <utility>

#include "modules/runtime/event_log.h"

namespace declutter::launcher {
namespace {

constexpr int kPriority = -10;
constexpr double kMarkPeriod_s = 0.2;
constexpr std::streamoff kTail = 1 << 20;  // [byte] of the log in which the mark is searched
constexpr int8_t kFinished = 2;            // module_status_t::state
constexpr double kLookPeriod_s = 1.0;

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

// The rest is sent at any time, also outside the run.
bool IsCounted(const std::string& channel) {
  return channel != kModuleStatus.name && channel != kRunInfo.name && channel != "LCM_SELF_TEST";
}

double FreeMegabytes(const std::string& path) {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  const auto space = std::filesystem::space(folder, error);
  // What cannot be looked at is for lcm-logger to complain of.
  return error ? std::numeric_limits<double>::max() : static_cast<double>(space.available) / 1e6;
}

std::string Megabytes(double size) { return std::to_string(static_cast<int64_t>(size)) + " MB"; }

int64_t WallClock_us() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

}  // namespace

Recorder::Recorder(LaunchPlan plan, Recording recording, const run_info_t& info, Wire* wire)
    : Program(std::move(plan)),
      recording_(std::move(recording)),
      info_(Encode(kRunInfo, info)),
      wire_(wire) {}

void Recorder::Tell(const run_info_t& info) {
  info_ = Encode(kRunInfo, info);
  if (is_ready_ && !is_ending_) wire_->Publish(info_);
}

void Recorder::Start() {
  if (recording_.is_split) old_file_ = CurrentFile();
  Program::Start();
  // Late, it loses messages: it goes first where we may say so.
  setpriority(PRIO_PROCESS, static_cast<id_t>(pid()), kPriority);
  end_mark_ = {};
  is_complete_ = is_disk_full_ = false;
}

void Recorder::Terminate() {
  if (!is_ready_) return Kill();
  is_ending_ = true;
  module_status_t status = {};
  status.utime = WallClock_us();
  status.module = status.program = "launcher";
  status.pid = ::getpid();
  status.state = kFinished;
  end_mark_ = Encode(kModuleStatus, status);
  mark_s_ = 0.0;
}

void Recorder::OnMessage(const Message& message) {
  if (is_ready_ && IsCounted(message.channel)) ++num_heard_;
}

void Recorder::OnTurn(double now_s) {
  Program::OnTurn(now_s);
  if (pid() < 0 || is_complete_) return;
  if (!is_ready_) {
    file_ = CurrentFile();
    if (file_ == old_file_ || !TailHolds(file_, info_.bytes)) return Await(info_, now_s);
    is_ready_ = true;
  }
  if (!is_ending_) return LookAround(now_s);
  if (!TailHolds(CurrentFile(), end_mark_.bytes)) return Await(end_mark_, now_s);
  is_complete_ = true;
  Signal(SIGTERM);
}

void Recorder::Await(const Message& mark, double now_s) {
  if (now_s - mark_s_ < kMarkPeriod_s) return;
  mark_s_ = now_s;
  wire_->Publish(mark);
}

void Recorder::LookAround(double now_s) {
  if (now_s - look_s_ < kLookPeriod_s) return;
  look_s_ = now_s;
  if (file_ != CurrentFile()) {
    file_ = CurrentFile();
    wire_->Publish(info_);
  }
  if (FreeMegabytes(recording_.path) >= recording_.min_free_mb) return;
  is_disk_full_ = true;
  Terminate();
}

std::string Recorder::CurrentFile() const {
  if (!recording_.is_split) return recording_.path;
  std::string newest;
  for (int i = 0;; ++i) {
    char suffix[16];
    std::snprintf(suffix, sizeof(suffix), ".%02d", i);
    const std::string file = recording_.path + suffix;
    if (!std::filesystem::exists(file)) return newest;
    newest = file;
  }
}

Ending Recorder::Judge(const Ending& ending) const {
  if (ending.code != 0) return ending;
  if (is_disk_full_) {
    return {2, 0,
            "a disk that has less than " + Megabytes(recording_.min_free_mb) +
                " left; what was recorded is whole"};
  }
  if (!is_complete_) return {1, 0, "an incomplete log " + CurrentFile()};
  if (recording_.is_split) return {};
  int64_t num_recorded = 0;
  try {
    runtime::EventLogReader reader(recording_.path);
    while (const auto event = reader.Next()) num_recorded += IsCounted(event->channel) ? 1 : 0;
  } catch (const std::runtime_error& error) {
    return {1, 0, error.what()};
  }
  if (num_recorded >= num_heard_) return {};
  return {1, 0,
          "a log that lacks " + std::to_string(num_heard_ - num_recorded) + " of " +
              std::to_string(num_heard_) + " messages"};
}

void CheckFreeSpace(const Recording& recording) {
  const double free_mb = FreeMegabytes(recording.path);
  if (free_mb >= recording.min_free_mb) return;
  throw std::runtime_error(recording.path + ": the disk has " + Megabytes(free_mb) +
                           " left, to record needs " + Megabytes(recording.min_free_mb));
}

}  // namespace declutter::launcher
