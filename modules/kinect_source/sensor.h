#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

#include "modules/geometry/depth_image.h"

namespace declutter {

// What a depth sensor gives at one time.
struct SensorFrame {
  int64_t device_us = 0;  // [us] of the sensor's own clock
  int64_t index = 0;      // counts the sensor's frames: what is missing was not read
  DepthImage depth;
  std::optional<ColorImage> color;  // registered to depth
};

// What is asked of a sensor.
struct SensorRequest {
  // Empty: the first that can be opened; serial=NUMBER; else an OpenNI2 URI or the path of an .oni
  // file.
  std::string device;
  int width = 0, height = 0;  // [px] 0: 640 x 480 if it has that, else its default
  int rate_hz = 0;            // 0: 30 Hz if it has that, else its default
  bool color = true;
  bool auto_exposure = true;
  bool auto_white_balance = true;
  std::string record_oni;         // a new .oni file; empty: none
  double record_min_free_mb = 0;  // on the disk, else nothing is recorded any more
};

// There is no such sensor, or it cannot be opened now.
class NoSensor : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The sensor cannot do what is asked; what() says what it can.
class UnsupportedRequest : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

// A frame whose data is not a whole image. The next may be whole again.
class DamagedFrame : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// An open depth sensor.
class Sensor {
 public:
  virtual ~Sensor() = default;

  // The newest frame that was not read yet; waits for one no longer than about timeout_s. Throws
  // DamagedFrame.
  virtual std::optional<SensorFrame> Read(double timeout_s) = 0;

  // False when the device is gone: then nothing comes any more.
  virtual bool is_connected() const = 0;

  // What has gone wrong beside the frames since the last call; empty: nothing.
  virtual std::string TakeFailure() = 0;

  // Model and URI, and what of the request it goes without, for people.
  virtual std::string description() const = 0;
};

}  // namespace declutter
