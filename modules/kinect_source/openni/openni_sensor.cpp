#include "modules/kinect_source/openni/openni_sensor.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "modules/kinect_source/openni/frame_copy.h"
#include "modules/kinect_source/openni/openni_error.h"
#include "modules/kinect_source/openni/video_modes.h"

namespace declutter {
namespace {

using openni::STATUS_OK;
using openni::VideoMode;
using openni::VideoStream;

// Longer than a period of any mode: by then the colour of a depth image has come. In a file, where
// the next frame always comes, the clock must not decide.
constexpr int kColorWait_ms = 50;
constexpr int kFramesPerDiskCheck = 30;

// The player of a file, which runs on its own, looks through the streams between two frames without
// a lock, and crashes when one is destroyed meanwhile, or when the file is closed before it has
// begun. Nothing tells where it is, but left alone it soon waits for the next frame to be asked
// for, and then may lose its streams.
void LetPlayerWait() {
  constexpr int kLongEnough_ms = 500;
  int ignored = 0;
  openni::OpenNI::waitForAnyStream(nullptr, 0, &ignored, kLongEnough_ms);
}

}  // namespace

OpenniSensor::OpenniSensor(const std::string& uri, const SensorRequest& request)
    : uri_(uri), record_path_(request.record_oni), record_min_free_mb_(request.record_min_free_mb) {
  if (device_.open(uri.c_str()) != STATUS_OK) {
    throw NoSensor(uri + ": cannot be opened: " + OpenniError());
  }
  try {
    OpenDepth(request);
    if (request.color) OpenColor(request);
    if (device_.isFile()) ReadOnDemand();
    GuardDisk();
    if (!record_path_.empty()) Record();
    ReadProperties();
    Start();
  } catch (...) {
    if (device_.isFile()) LetPlayerWait();
    throw;
  }
  openni::OpenNI::addDeviceDisconnectedListener(this);
}

OpenniSensor::~OpenniSensor() {
  openni::OpenNI::removeDeviceDisconnectedListener(this);
  if (device_.isFile()) LetPlayerWait();
  // A recorder that lets go of a running stream can wait for it for ever.
  color_.stop();
  depth_.stop();
  recorder_.destroy();
  color_.destroy();
  depth_.destroy();
  device_.close();
}

void OpenniSensor::OpenDepth(const SensorRequest& request) {
  if (!device_.hasSensor(openni::SENSOR_DEPTH)) {
    throw UnsupportedRequest(uri_ + ": has no depth stream");
  }
  if (depth_.create(device_, openni::SENSOR_DEPTH) != STATUS_OK) {
    throw NoSensor(uri_ + ": depth stream cannot be opened: " + OpenniError());
  }
  SetMode(request, &depth_, "depth");
}

// A sensor that lacks what is needed for colour is used without.
void OpenniSensor::OpenColor(const SensorRequest& request) {
  if (!device_.hasSensor(openni::SENSOR_COLOR)) {
    lacks_ = "has no colour";
    return;
  }
  constexpr auto kRegistered = openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR;
  // A file does not tell whether it is registered; it was if it was recorded here.
  if (!device_.isFile() && (!device_.isImageRegistrationModeSupported(kRegistered) ||
                            device_.setImageRegistrationMode(kRegistered) != STATUS_OK)) {
    lacks_ = "cannot register depth to colour: no colour";
    return;
  }
  if (color_.create(device_, openni::SENSOR_COLOR) != STATUS_OK) {
    throw NoSensor(uri_ + ": colour stream cannot be opened: " + OpenniError());
  }
  SensorRequest same = request;
  same.width = depth_.getVideoMode().getResolutionX();
  same.height = depth_.getVideoMode().getResolutionY();
  try {
    SetMode(same, &color_, "colour");
  } catch (const UnsupportedRequest&) {
    color_.destroy();
    device_.setImageRegistrationMode(openni::IMAGE_REGISTRATION_OFF);
    lacks_ = "has no colour of the size of its depth";
    return;
  }
  if (openni::CameraSettings* settings = color_.getCameraSettings()) {
    const bool obeys =
        settings->setAutoExposureEnabled(request.auto_exposure) == STATUS_OK &&
        settings->setAutoWhiteBalanceEnabled(request.auto_white_balance) == STATUS_OK;
    if (!obeys) lacks_ = "has no choice of auto_exposure and auto_white_balance";
  }
}

void OpenniSensor::SetMode(const SensorRequest& request, VideoStream* stream, const char* what) {
  const std::optional<VideoMode> mode = ChooseMode(*stream, request);
  if (!mode) {
    throw UnsupportedRequest(uri_ + ": no " + what + " with " + AskedText(request) +
                             "; supported: " + SupportedText(*stream));
  }
  if (device_.isFile()) return;  // has one mode, and no setting
  if (stream->setVideoMode(*mode) != STATUS_OK) {
    throw NoSensor(uri_ + ": refuses " + what + " with " + AskedText(request) + ": " +
                   OpenniError());
  }
  if (stream->isCroppingSupported()) stream->resetCropping();
  stream->setMirroringEnabled(false);
}

void OpenniSensor::ReadOnDemand() {
  openni::PlaybackControl* playback = device_.getPlaybackControl();
  if (playback == nullptr) throw NoSensor(uri_ + ": cannot be played");
  num_frames_ = playback->getNumberOfFrames(depth_);
  if (num_frames_ <= 0) throw NoSensor(uri_ + ": no depth frames in it");
  playback->setRepeatEnabled(true);  // at the end the player would not wait: see LetPlayerWait
  playback->setSpeed(-1);            // a frame for each that is waited for
  loop_clock_.emplace(PeriodUs());
}

void OpenniSensor::Record() {
  const auto attach = [this](VideoStream& stream) {
    return !stream.isValid() || recorder_.attach(stream) == STATUS_OK;
  };
  if (recorder_.create(record_path_.c_str()) != STATUS_OK || !attach(depth_) || !attach(color_) ||
      recorder_.start() != STATUS_OK) {
    throw UnsupportedRequest(record_path_ + ": cannot be recorded: " + OpenniError());
  }
}

// The recorder says nothing of a full disk, and leaves a file that cannot be read.
void OpenniSensor::GuardDisk() {
  if (record_path_.empty()) return;
  std::error_code error;
  const auto folder = std::filesystem::absolute(record_path_).parent_path();
  const std::filesystem::space_info space = std::filesystem::space(folder, error);
  if (error || 1e-6 * static_cast<double>(space.available) >= record_min_free_mb_) return;
  failure_ = record_path_ + ": recording ends: less than " +
             std::to_string(std::llround(record_min_free_mb_)) + " MB free on the disk";
  recorder_.stop();
  record_path_.clear();
}

// A file's must not be asked for while it plays: the player sets them again when it begins again.
void OpenniSensor::ReadProperties() {
  const VideoStream& stream = color_.isValid() ? color_ : depth_;
  horizontal_fov_rad_ = stream.getHorizontalFieldOfView();
  vertical_fov_rad_ = stream.getVerticalFieldOfView();
  depth_is_mirrored_ = depth_.getMirroringEnabled();
  if (!color_.isValid()) return;
  color_is_mirrored_ = color_.getMirroringEnabled();
  match_.emplace(PeriodUs());
}

int64_t OpenniSensor::PeriodUs() const {
  return 1'000'000 / std::max(1, depth_.getVideoMode().getFps());
}

void OpenniSensor::Start() {
  const bool has_color = color_.isValid();
  if (has_color && color_.start() != STATUS_OK) {
    throw NoSensor(uri_ + ": colour stream cannot be started: " + OpenniError());
  }
  if (depth_.start() != STATUS_OK) {
    throw NoSensor(uri_ + ": depth stream cannot be started: " + OpenniError());
  }
}

std::string OpenniSensor::description() const {
  const openni::DeviceInfo& info = device_.getDeviceInfo();
  const VideoMode mode = depth_.getVideoMode();
  return std::string(info.getVendor()) + " " + info.getName() + " (" + info.getUri() + "), " +
         std::to_string(mode.getResolutionX()) + "x" + std::to_string(mode.getResolutionY()) +
         " px at " + std::to_string(mode.getFps()) + " Hz" + (lacks_.empty() ? "" : ", ") + lacks_;
}

void OpenniSensor::onDeviceDisconnected(const openni::DeviceInfo* info) {
  if (uri_ == info->getUri()) is_connected_ = false;
}

std::optional<SensorFrame> OpenniSensor::Read(double timeout_s) {
  VideoStream* streams[] = {&depth_, &color_};
  const int num_streams = color_.isValid() ? 2 : 1;
  while (!ready_) {
    const bool waits_for_color = match_ && match_->is_waiting();
    const int timeout_ms = waits_for_color && !device_.isFile()
                               ? kColorWait_ms
                               : static_cast<int>(std::ceil(1000 * timeout_s));
    int index = 0;
    if (openni::OpenNI::waitForAnyStream(streams, num_streams, &index, timeout_ms) != STATUS_OK) {
      if (waits_for_color) ready_ = match_->TakeAnyhow();
      break;
    }
    openni::VideoFrameRef frame;
    if (streams[index]->readFrame(&frame) != STATUS_OK || !frame.isValid()) break;
    index == 0 ? AddDepth(frame) : AddColor(frame);
    if (!ready_ && match_) ready_ = match_->Take();
  }
  return std::exchange(ready_, std::nullopt);
}

void OpenniSensor::AddDepth(const openni::VideoFrameRef& frame) {
  if (frame.getFrameIndex() % kFramesPerDiskCheck == 0) GuardDisk();
  const LoopClock::Time time = TimeOf(frame, LoopClock::kDepth);
  SensorFrame read;
  read.device_us = time.device_us;
  read.index = frame.getFrameIndex() + time.loop * num_frames_;
  read.depth = CopyDepth(frame, depth_is_mirrored_);
  read.depth.camera = CameraOf(frame);
  ready_ = match_ ? match_->AddDepth(std::move(read)) : std::move(read);
}

void OpenniSensor::AddColor(const openni::VideoFrameRef& frame) {
  match_->AddColor(TimeOf(frame, LoopClock::kColor).device_us,
                   CopyColor(frame, color_is_mirrored_));
}

LoopClock::Time OpenniSensor::TimeOf(const openni::VideoFrameRef& frame, LoopClock::Stream stream) {
  const auto device_us = static_cast<int64_t>(frame.getTimestamp());
  if (!loop_clock_) return {0, device_us};
  return loop_clock_->At(stream, frame.getFrameIndex(), device_us);
}

// The principal point of a device that tells only its field of view is the middle of its image. An
// image registered to colour is that of the colour camera.
PinholeCamera OpenniSensor::CameraOf(const openni::VideoFrameRef& frame) const {
  const int full_width = frame.getVideoMode().getResolutionX();
  const int full_height = frame.getVideoMode().getResolutionY();
  PinholeCamera camera{frame.getWidth(), frame.getHeight()};
  camera.fx = 0.5 * full_width / std::tan(0.5 * horizontal_fov_rad_);
  camera.fy = 0.5 * full_height / std::tan(0.5 * vertical_fov_rad_);
  camera.cx = 0.5 * (full_width - 1);
  camera.cy = 0.5 * (full_height - 1);
  if (frame.getCroppingEnabled()) {
    camera.cx -= frame.getCropOriginX();
    camera.cy -= frame.getCropOriginY();
  }
  return camera;
}

}  // namespace declutter
