#include "modules/kinect_source/live_reader.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "modules/kinect_source/recording_reader.h"

namespace declutter {
namespace {

constexpr double kReadTimeout_s = 0.02;
constexpr double kClosedWait_s = 0.05;
constexpr int64_t kReopenPeriod_us = 500'000;
constexpr int64_t kMaxSilence_us = 1'000'000;
constexpr int64_t kMaxSilenceAtFirst_us = 5'000'000;  // a Kinect starts slowly
constexpr int64_t kMaxEmptiness_us = 1'000'000;

}  // namespace

LiveReader::LiveReader(const KinectSourceConfig& config, OpenSensor open, Now now_us,
                       SensorEvents events)
    : config_(config),
      open_(std::move(open)),
      now_us_(std::move(now_us)),
      events_(std::move(events)),
      X_WC_(CameraPose(config)) {
  Open();
}

LiveReader::~LiveReader() {
  if (sensor_) events_.note(Figures());
}

void LiveReader::Open() {
  sensor_ = open_();
  clock_.Restart();
  silent_since_us_.reset();
  empty_since_us_.reset();
  last_index_ = 0;
  num_read_ = 0;
  num_skipped_ = 0;
  events_.note("sensor: " + sensor_->description());
}

void LiveReader::OpenAgain() {
  if (now_us_() < next_open_us_) return;
  try {
    Open();
  } catch (const std::exception& error) {  // also what another device at this place cannot do
    next_open_us_ = now_us_() + kReopenPeriod_us;
    SetTrouble("no sensor: " + std::string(error.what()));
  }
}

void LiveReader::Close(const std::string& why) {
  events_.note(Figures());
  sensor_.reset();
  next_open_us_ = now_us_();
  SetTrouble("no sensor: " + why);
}

void LiveReader::SetTrouble(const std::string& trouble) {
  if (trouble == trouble_) return;
  trouble_ = trouble;
  events_.trouble(trouble);
}

ReadResult LiveReader::Read() {
  ReadResult result;
  if (!sensor_) OpenAgain();
  if (!sensor_) {
    result.wait_s = kClosedWait_s;
    return result;
  }
  std::optional<SensorFrame> read = ReadSensor();
  if (!read) return result;
  const int64_t utime = clock_.ToUtime(read->device_us, now_us_());
  CountMissing(*read);
  WatchForEmptiness(read->depth);
  if (num_read_++ < config_.warm_up_frames()) return result;
  char name[24];
  std::snprintf(name, sizeof(name), "%06lld", static_cast<long long>(num_frames_++));
  result.frame.emplace();
  result.frame->depth = {{utime, name, ""}, std::move(read->depth), X_WC_};
  result.frame->color = std::move(read->color);
  return result;
}

std::optional<SensorFrame> LiveReader::ReadSensor() {
  std::optional<SensorFrame> frame;
  try {
    frame = sensor_->Read(kReadTimeout_s);
  } catch (const DamagedFrame& error) {
    silent_since_us_.reset();
    events_.rejected(error.what());
    return std::nullopt;
  }
  const std::string failure = sensor_->TakeFailure();
  if (!failure.empty()) events_.failed(failure);
  if (frame) {
    silent_since_us_.reset();
  } else if (!sensor_->is_connected()) {
    Close("unplugged");
  } else if (IsStalled()) {
    Close("it sends no frames");
  }
  return frame;
}

bool LiveReader::IsStalled() {
  const int64_t now_us = now_us_();
  if (!silent_since_us_) silent_since_us_ = now_us;
  const int64_t limit_us = num_read_ == 0 ? kMaxSilenceAtFirst_us : kMaxSilence_us;
  return now_us - *silent_since_us_ > limit_us;
}

void LiveReader::CountMissing(const SensorFrame& frame) {
  const int64_t num_missing = frame.index - last_index_ - 1;
  last_index_ = frame.index;
  if (num_read_ == 0 || num_missing <= 0) return;
  num_skipped_ += num_missing;
  events_.skipped(num_missing);
}

void LiveReader::WatchForEmptiness(const DepthImage& image) {
  const bool is_empty = std::all_of(image.counts.begin(), image.counts.end(),
                                    [](uint16_t count) { return count == 0; });
  const int64_t now_us = now_us_();
  if (!is_empty) {
    empty_since_us_.reset();
    SetTrouble("");
  } else if (!empty_since_us_) {
    empty_since_us_ = now_us;
  } else if (now_us - *empty_since_us_ > kMaxEmptiness_us) {
    SetTrouble("the sensor measures nothing: is it covered, or too close?");
  }
}

std::string LiveReader::Figures() const {
  char text[160];
  std::snprintf(text, sizeof(text),
                "sensor: %lld frames read, %lld skipped, arrival jitter %.1f ms, %lld time jumps",
                static_cast<long long>(num_read_), static_cast<long long>(num_skipped_),
                1e-3 * clock_.jitter_us(), static_cast<long long>(clock_.num_jumps()));
  return text;
}

}  // namespace declutter
