#include "modules/runtime/health.h"

#include <algorithm>

namespace declutter::runtime {

void Health::Arrived(std::int64_t utime, double now_ms) {
  const std::lock_guard<std::mutex> lock(mutex_);
  frame_times_.Begin(utime, now_ms);
}

void Health::Took() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++num_in_;
}

void Health::Handled(std::int64_t utime, double processing_ms) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++num_handled_;
  ++num_timed_;
  last_utime_ = utime;
  processing_ms_ += processing_ms;
  max_processing_ms_ = std::max(max_processing_ms_, processing_ms);
}

void Health::Done() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++num_done_;
}

void Health::Published(std::int64_t utime, double now_ms) {
  const std::lock_guard<std::mutex> lock(mutex_);
  frame_times_.Begin(utime, now_ms);
  CountOut(utime);
  ++num_messages_;
  last_utime_ = utime;
}

void Health::Ended(std::int64_t utime, double now_ms) {
  const std::lock_guard<std::mutex> lock(mutex_);
  frame_times_.End(utime, now_ms);
}

void Health::GaveOut(std::int64_t utime) {
  const std::lock_guard<std::mutex> lock(mutex_);
  CountOut(utime);
}

// The messages of one frame follow each other.
void Health::CountOut(std::int64_t utime) {
  if (num_out_ == 0 || utime != last_out_utime_) ++num_out_;
  last_out_utime_ = utime;
}

void Health::Skipped(std::int64_t num_frames) {
  const std::lock_guard<std::mutex> lock(mutex_);
  num_skipped_ += num_frames;
}

void Health::Rejected() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++num_rejected_;
}

void Health::Complain(const std::string& text) {
  const std::lock_guard<std::mutex> lock(mutex_);
  complaint_ = text;
}

void Health::SetTrouble(const std::string& text) {
  const std::lock_guard<std::mutex> lock(mutex_);
  trouble_ = text;
}

module_status_t Health::Report() {
  const std::lock_guard<std::mutex> lock(mutex_);
  module_status_t status{};
  status.num_in = num_in_;
  status.num_done = num_done_;
  status.num_out = num_out_;
  status.num_messages = num_messages_;
  status.num_skipped = num_skipped_;
  status.num_rejected = num_rejected_;
  status.last_utime = last_utime_;
  status.processing_ms = num_timed_ > 0 ? processing_ms_ / num_timed_ : 0;
  status.max_processing_ms = max_processing_ms_;
  const FrameTimes::Latency latency = frame_times_.Take();
  status.latency_ms = latency.median_ms;
  status.max_latency_ms = latency.max_ms;
  status.message = complaint_.empty() ? trouble_ : complaint_;
  num_timed_ = 0;
  processing_ms_ = 0;
  max_processing_ms_ = 0;
  complaint_.clear();
  return status;
}

std::int64_t Health::num_handled() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return num_handled_;
}

std::int64_t Health::num_rejected() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return num_rejected_;
}

}  // namespace declutter::runtime
