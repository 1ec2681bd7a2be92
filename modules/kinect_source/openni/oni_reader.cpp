#include "modules/kinect_source/openni/oni_reader.h"

#include <cstdio>
#include <filesystem>
#include <utility>

namespace declutter {
namespace {

// The player decodes a frame in milliseconds.
constexpr double kReadTimeout_s = 3;

std::string Named(int64_t number) {
  char name[24];
  std::snprintf(name, sizeof(name), "%06lld", static_cast<long long>(number));
  return name;
}

}  // namespace

OniReader::OniReader(const KinectSourceConfig& config, const SensorRequest& request)
    : request_(request), loop_(config.loop()), X_WC_(CameraPose(config)) {
  if (!std::filesystem::exists(request.device)) {
    throw NoSensor(request.device + ": no such file");
  }
  Rewind();
}

void OniReader::Rewind() {
  file_.reset();
  try {
    file_ = std::make_unique<OpenniSensor>(request_.device, request_);
  } catch (const NoSensor& error) {
    throw NoSensor(std::string(error.what()) + " (cut short, or no .oni file?)");
  }
  num_read_ = 0;
}

std::optional<RecordedFrame> OniReader::Next() {
  if (num_read_ >= file_->num_frames()) {
    if (!loop_) return std::nullopt;
    loop_offset_us_ = last_utime_ + kFramePeriodUs;
    Rewind();
  }
  RecordedFrame frame;
  frame.depth.X_WC = X_WC_;
  frame.depth.header = {last_utime_ + kFramePeriodUs, Named(num_read_), ""};
  ++num_read_;
  try {
    std::optional<SensorFrame> read = file_->Read(kReadTimeout_s);
    if (!read) {
      frame.depth.header.error = "the file ends before this frame";
      num_read_ = file_->num_frames();
      return frame;
    }
    frame.depth.header.utime = loop_offset_us_ + read->device_us;
    frame.depth.image = std::move(read->depth);
    frame.color = std::move(read->color);
  } catch (const DamagedFrame& error) {
    frame.depth.header.error = error.what();
  }
  last_utime_ = frame.depth.header.utime;
  return frame;
}

}  // namespace declutter
