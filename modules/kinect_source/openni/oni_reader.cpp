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
    : loop_(config.loop()), X_WC_(CameraPose(config)) {
  if (!std::filesystem::exists(request.device)) {
    throw NoSensor(request.device + ": no such file");
  }
  try {
    file_ = std::make_unique<OpenniSensor>(request.device, request);
  } catch (const NoSensor& error) {
    throw NoSensor(std::string(error.what()) + " (cut short, or no .oni file?)");
  }
}

std::optional<RecordedFrame> OniReader::Next() {
  const int64_t num_frames = file_->num_frames();
  if (!loop_ && num_read_ >= num_frames) return std::nullopt;
  RecordedFrame frame;
  frame.depth.X_WC = X_WC_;
  frame.depth.header = {last_utime_ + kFramePeriodUs, Named(num_read_ % num_frames), ""};
  ++num_read_;
  try {
    std::optional<SensorFrame> read = file_->Read(kReadTimeout_s);
    if (!read || (!loop_ && read->index > num_frames)) {
      frame.depth.header.error = "the file ends before this frame";
      num_read_ = num_frames;
      return frame;
    }
    frame.depth.header.utime = read->device_us;
    frame.depth.image = std::move(read->depth);
    frame.color = std::move(read->color);
  } catch (const DamagedFrame& error) {
    frame.depth.header.error = error.what();
  }
  last_utime_ = frame.depth.header.utime;
  return frame;
}

}  // namespace declutter
