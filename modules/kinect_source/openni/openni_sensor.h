#pragma once

#include <OpenNI.h>

#include <atomic>
#include <memory>
#include <string>
#include <utility>

#include "modules/kinect_source/color_match.h"
#include "modules/kinect_source/loop_clock.h"
#include "modules/kinect_source/sensor.h"

namespace declutter {

// A device or an .oni file with its streams running. A file is read frame by frame, as fast as Read
// is called; after its last frame it begins again, and index and time of the frames go on.
class OpenniSensor : public Sensor, private openni::OpenNI::DeviceDisconnectedListener {
 public:
  // Throws NoSensor, UnsupportedRequest.
  OpenniSensor(const std::string& uri, const SensorRequest& request);
  ~OpenniSensor() override;

  std::optional<SensorFrame> Read(double timeout_s) override;
  bool is_connected() const override { return is_connected_; }
  std::string TakeFailure() override { return std::exchange(failure_, ""); }
  std::string description() const override;

  // Depth frames of a file; 0 for a device.
  int num_frames() const { return num_frames_; }

 private:
  void onDeviceDisconnected(const openni::DeviceInfo* info) override;

  void OpenDepth(const SensorRequest& request);
  void OpenColor(const SensorRequest& request);
  void SetMode(const SensorRequest& request, openni::VideoStream* stream, const char* what);
  void ReadOnDemand();
  void Record();
  void GuardDisk();
  void ReadProperties();
  void Start();
  int64_t PeriodUs() const;
  void AddDepth(const openni::VideoFrameRef& frame);
  void AddColor(const openni::VideoFrameRef& frame);
  LoopClock::Time TimeOf(const openni::VideoFrameRef& frame, LoopClock::Stream stream);
  PinholeCamera CameraOf(const openni::VideoFrameRef& frame) const;

  std::string uri_;
  openni::Device device_;
  openni::VideoStream depth_;
  openni::VideoStream color_;
  openni::Recorder recorder_;
  std::string record_path_;  // empty: nothing is recorded
  double record_min_free_mb_;
  std::string failure_;
  std::optional<ColorMatch> match_;
  std::optional<SensorFrame> ready_;
  std::string lacks_;  // what of the request it goes without
  int num_frames_ = 0;
  std::optional<LoopClock> loop_clock_;  // of a file
  double horizontal_fov_rad_ = 0, vertical_fov_rad_ = 0;
  bool depth_is_mirrored_ = false, color_is_mirrored_ = false;
  std::atomic<bool> is_connected_{true};
};

}  // namespace declutter
