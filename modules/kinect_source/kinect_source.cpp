#include "modules/kinect_source/kinect_source.h"

#include <algorithm>
#include <utility>

namespace declutter {
namespace {

// Of a recording with a gap.
constexpr double kLongestPause_s = 5;

}  // namespace

KinectSource::KinectSource(const KinectSourceConfig& config, bool lossless, Input input,
                           ReadFrame read_frame)
    : config_(config), lossless_(lossless), input_(input), read_frame_(std::move(read_frame)) {}

KinectSource::Step KinectSource::Advance(double now_s) {
  // The next frame of a recording is read while the last one is on its way.
  const bool is_blocked = lossless_ && awaits_result_;
  if (!is_blocked || input_ == Input::kRecording) ReadNext();
  if (awaits_result_ && (lossless_ || at_end_)) {
    const double left_s = sent_s_ + config_.result_timeout_s() - now_s;
    if (left_s > 0) return {nullptr, "", left_s};
    if (lossless_) return Resend(now_s);
  }
  if (at_end_) return {nullptr, "", std::nullopt};
  if (!next_) return {nullptr, "", read_again_s_};
  const double due_s = in_flight_ ? due_s_ + PeriodUntil(*next_) : now_s;
  if (!lossless_ && now_s < due_s) return {nullptr, "", due_s - now_s};
  // A source that fell behind does not catch up in a burst.
  due_s_ = now_s - due_s > PeriodUntil(*next_) ? now_s : due_s;
  return Begin(now_s);
}

void KinectSource::OnResult(int64_t utime) {
  if (in_flight_ && in_flight_->depth.header.utime == utime) awaits_result_ = false;
}

void KinectSource::ReadNext() {
  if (next_ || at_end_) return;
  at_end_ = config_.num_frames() > 0 && num_read_ == config_.num_frames();
  if (at_end_) return;
  ReadResult read = read_frame_();
  next_ = std::move(read.frame);
  read_again_s_ = read.wait_s;
  at_end_ = read.at_end;
  if (next_) ++num_read_;
}

// From in_flight_ to the next frame, when both leave as fast as they should [s].
double KinectSource::PeriodUntil(const RecordedFrame& next) const {
  if (input_ == Input::kSensor || !in_flight_) return 0;
  if (config_.rate_hz() > 0) return 1 / config_.rate_hz();
  const int64_t taken_us = next.depth.header.utime - in_flight_->depth.header.utime;
  return std::clamp(1e-6 * static_cast<double>(taken_us), 0.0, kLongestPause_s);
}

KinectSource::Step KinectSource::Begin(double now_s) {
  in_flight_ = std::move(next_);
  next_.reset();
  awaits_result_ = true;
  num_tries_ = 1;
  sent_s_ = now_s;
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
