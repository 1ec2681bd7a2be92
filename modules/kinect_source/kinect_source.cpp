#include "modules/kinect_source/kinect_source.h"

#include <algorithm>
#include <utility>

namespace declutter {

KinectSource::KinectSource(const KinectSourceConfig& config, bool lossless, ReadFrame read_frame)
    : config_(config), lossless_(lossless), read_frame_(std::move(read_frame)) {}

KinectSource::Step KinectSource::Advance(double now_s) {
  // The next frame is read while the last one is on its way.
  const bool has_next = ReadAhead();
  const bool must_wait = awaits_result_ && (lossless_ || !has_next);
  if (must_wait) {
    const double left_s = sent_s_ + config_.result_timeout_s() - now_s;
    if (left_s > 0) return {nullptr, "", left_s};
    if (lossless_) return Resend(now_s);
  }
  if (!has_next) return {nullptr, "", std::nullopt};
  if (!lossless_ && now_s < due_s_) return {nullptr, "", due_s_ - now_s};
  return Begin(now_s);
}

void KinectSource::OnResult(int64_t utime) {
  if (in_flight_ && in_flight_->depth.header.utime == utime) awaits_result_ = false;
}

bool KinectSource::ReadAhead() {
  if (!next_ && !at_end_) {
    next_ = read_frame_();
    at_end_ = !next_;
  }
  return next_.has_value();
}

KinectSource::Step KinectSource::Begin(double now_s) {
  in_flight_ = std::move(next_);
  next_.reset();
  awaits_result_ = true;
  num_tries_ = 1;
  sent_s_ = now_s;
  // A source that fell behind does not catch up in a burst.
  const double period_s = 1 / config_.rate_hz();
  due_s_ = now_s - due_s_ > period_s ? now_s + period_s : due_s_ + period_s;
  Step step{&*in_flight_, "", 0.0};
  const FrameHeader& header = in_flight_->depth.header;
  const std::string& what = header.error.empty() ? in_flight_->color_error : header.error;
  if (!what.empty()) step.failure = header.frame + ": " + what;
  return step;
}

KinectSource::Step KinectSource::Resend(double now_s) {
  FrameHeader& header = in_flight_->depth.header;
  ++num_tries_;
  sent_s_ = now_s;
  if (num_tries_ <= config_.max_tries()) return {&*in_flight_, "", 0.0};
  if (num_tries_ == config_.max_tries() + 1) {
    header.error = "no result after " + std::to_string(config_.max_tries()) + " tries";
    in_flight_->depth.image = {};
    in_flight_->color.reset();
    return {&*in_flight_, header.frame + ": " + header.error, 0.0};
  }
  awaits_result_ = false;
  return {nullptr, header.frame + ": lost, no result even for its error", 0.0};
}

}  // namespace declutter
