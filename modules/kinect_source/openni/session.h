#pragma once

#include <memory>
#include <string>
#include <vector>

#include "modules/kinect_source/sensor.h"

namespace declutter {

// A device that OpenNI2 knows.
struct ListedSensor {
  std::string uri;
  std::string name;     // vendor and model
  std::string serial;   // empty when it tells none
  std::string trouble;  // why it cannot be opened; empty when it can
};

// OpenNI2 with its drivers, which are in the folder OpenNI2/Drivers beside its library. One at a
// time; must outlive the sensors opened with it.
class OpenniSession {
 public:
  OpenniSession();  // throws NoSensor
  ~OpenniSession();
  OpenniSession(const OpenniSession&) = delete;
  OpenniSession& operator=(const OpenniSession&) = delete;

  // Opens a sensor and starts its streams, not mirrored, colour registered to depth. Throws
  // NoSensor, UnsupportedRequest.
  std::unique_ptr<Sensor> Open(const SensorRequest& request) const;

  // The devices that are there now, each opened for a moment.
  std::vector<ListedSensor> List() const;

  // Files of the drivers.
  static std::vector<std::string> Drivers();

 private:
  std::string UriOf(const std::string& device) const;
};

}  // namespace declutter
