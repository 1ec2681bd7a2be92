#include "modules/kinect_source/openni/input.h"

#include <cmath>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <utility>

#include "modules/kinect_source/calibration.h"
#include "modules/kinect_source/openni/oni_reader.h"
#include "modules/kinect_source/openni/session.h"
#include "modules/kinect_source/recording_reader.h"

namespace declutter {
namespace {

namespace fs = std::filesystem;

const std::string kLive = "live";

bool IsLive(const std::string& input) { return input == kLive || input.rfind(kLive + ":", 0) == 0; }

bool IsOniFile(const std::string& input) { return fs::path(input).extension() == ".oni"; }

SensorRequest RequestOf(const KinectSourceConfig& config, const Calibration& calibration) {
  if ((config.width() > 0) != (config.height() > 0)) {
    throw std::invalid_argument("width and height: both or none");
  }
  const double rate_hz = config.rate_hz();
  SensorRequest request;
  request.width = config.width();
  request.height = config.height();
  if (request.width == 0 && calibration.file()) {
    request.width = calibration.file()->camera.width;
    request.height = calibration.file()->camera.height;
  }
  request.rate_hz = static_cast<int>(std::lround(rate_hz));
  request.color = config.color();
  request.auto_exposure = config.auto_exposure();
  request.auto_white_balance = config.auto_white_balance();
  request.record_oni = config.record_oni();
  request.record_min_free_mb = config.record_min_free_mb();
  if (IsLive(config.input()) && rate_hz != request.rate_hz) {
    throw std::invalid_argument("rate_hz of a sensor is a whole number");
  }
  return request;
}

// NAME.oni, then NAME-2.oni ...: a recorder cannot go on in a file. None is overwritten.
std::string RecordingPath(const fs::path& path, int number) {
  if (path.empty()) return "";
  if (!IsOniFile(path)) throw std::invalid_argument(path.string() + ": must end in .oni");
  fs::path numbered = path;
  if (number > 1) {
    numbered.replace_filename(path.stem().string() + "-" + std::to_string(number) + ".oni");
  }
  if (fs::exists(numbered)) throw std::invalid_argument(numbered.string() + ": exists already");
  return numbered;
}

template <typename Reader>
Input RecordingInput(std::shared_ptr<Reader> reader) {
  const auto read = [reader] {
    ReadResult result;
    result.frame = reader->Next();
    result.at_end = !result.frame;
    return result;
  };
  return {KinectSource::Input::kRecording, read};
}

Input LiveInput(const KinectSourceConfig& config, const Calibration& calibration,
                LiveReader::Now now_us, SensorEvents events) {
  const auto session = std::make_shared<OpenniSession>();
  SensorRequest request = RequestOf(config, calibration);
  if (config.input() != kLive) request.device = config.input().substr(kLive.size() + 1);
  const auto open = [session, request, num_opened = 0]() mutable {
    SensorRequest numbered = request;
    numbered.record_oni = RecordingPath(request.record_oni, num_opened + 1);
    std::unique_ptr<Sensor> sensor = session->Open(numbered);
    ++num_opened;
    return sensor;
  };
  const auto reader = std::make_shared<LiveReader>(config, open, std::move(now_us), events);
  return {KinectSource::Input::kSensor, [session, reader] { return reader->Read(); }};
}

Input OniInput(const KinectSourceConfig& config, const Calibration& calibration) {
  const auto session = std::make_shared<OpenniSession>();
  SensorRequest request = RequestOf(config, calibration);
  request.device = config.input();
  request.rate_hz = 0;  // at which it was recorded; rate_hz is that of playing it
  try {
    Input input = RecordingInput(std::make_shared<OniReader>(config, request));
    input.read = [session, read = std::move(input.read)] { return read(); };
    return input;
  } catch (const NoSensor& error) {
    throw std::invalid_argument(error.what());
  }
}

Input OpenUncalibrated(const KinectSourceConfig& config, const Calibration& calibration,
                       LiveReader::Now now_us, SensorEvents events) {
  if (IsLive(config.input())) {
    return LiveInput(config, calibration, std::move(now_us), std::move(events));
  }
  if (!config.record_oni().empty()) {
    throw std::invalid_argument("record_oni: only a live sensor can be recorded");
  }
  if (IsOniFile(config.input())) return OniInput(config, calibration);
  return RecordingInput(std::make_shared<RecordingReader>(config));
}

}  // namespace

Input OpenInput(const KinectSourceConfig& config, LiveReader::Now now_us, SensorEvents events) {
  const bool has_intrinsics = !IsLive(config.input()) && !IsOniFile(config.input());
  const auto calibration = std::make_shared<Calibration>(config, has_intrinsics);
  const Input raw = OpenUncalibrated(config, *calibration, std::move(now_us), std::move(events));
  const auto read = [calibration, read_raw = raw.read] {
    ReadResult result = read_raw();
    if (result.frame) calibration->Apply(&*result.frame);
    return result;
  };
  return {raw.kind, read};
}

}  // namespace declutter
