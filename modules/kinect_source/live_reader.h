#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "modules/kinect_source/device_clock.h"
#include "modules/kinect_source/kinect_source.h"
#include "modules/kinect_source/kinect_source.pb.h"
#include "modules/kinect_source/sensor.h"

namespace declutter {

// What happens to a sensor beside its frames.
struct SensorEvents {
  std::function<void(const std::string&)> trouble;   // what is wrong from now on; empty: nothing
  std::function<void(int64_t)> skipped;              // so many frames were not read
  std::function<void(const std::string&)> rejected;  // a frame was of no use
  std::function<void(const std::string&)> failed;    // for good, though frames come
  std::function<void(const std::string&)> note;      // worth a line
};

// Reads a live sensor and keeps at it: a sensor that is gone, or sends nothing, is opened again
// until it is back.
class LiveReader {
 public:
  using OpenSensor = std::function<std::unique_ptr<Sensor>()>;
  using Now = std::function<int64_t()>;  // [us] since 1970 by a clock that never jumps

  // Opens the sensor; throws what open throws.
  LiveReader(const KinectSourceConfig& config, OpenSensor open, Now now_us, SensorEvents events);
  ~LiveReader();  // notes the figures of the last sensor

  // The newest frame that was not read yet; waits for it for some 20 ms. Frames are named by their
  // number, six digits from 000000 on.
  ReadResult Read();

 private:
  void Open();
  void OpenAgain();
  void Close(const std::string& why);
  void SetTrouble(const std::string& trouble);
  std::optional<SensorFrame> ReadSensor();
  bool IsStalled();
  void CountMissing(const SensorFrame& frame);
  void WatchForEmptiness(const DepthImage& image);
  std::string Figures() const;

  const KinectSourceConfig config_;
  const OpenSensor open_;
  const Now now_us_;
  const SensorEvents events_;
  Eigen::Isometry3d X_WC_;
  std::unique_ptr<Sensor> sensor_;
  DeviceClock clock_;
  std::string trouble_;
  int64_t next_open_us_ = 0;
  std::optional<int64_t> silent_since_us_;
  std::optional<int64_t> empty_since_us_;
  int64_t last_index_ = 0;  // of the sensor opened now, as the next two
  int64_t num_read_ = 0;
  int64_t num_skipped_ = 0;
  int64_t num_frames_ = 0;  // in all
};

}  // namespace declutter
