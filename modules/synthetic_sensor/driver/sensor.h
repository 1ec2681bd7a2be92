#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>

#include "modules/synthetic_sensor/fault_schedule.h"
#include "modules/synthetic_sensor/rendered_images.h"

namespace declutter {

// Rate of every stream [Hz].
inline constexpr int kSensorRate_hz = 30;

// What a stream has to send in a period.
struct SensorOutput {
  const DepthImage& depth;
  const ColorImage& color;
  int64_t n;           // of the period; the frame's index is n + 1
  uint64_t device_us;  // the frame's timestamp
  SensorPeriod period;
};

// A stream that was started. Receive is called by the sensor's own thread.
class SensorStream {
 public:
  virtual ~SensorStream() = default;
  virtual void Receive(const SensorOutput& output) = 0;
};

// The camera behind the device: described by a file, it lives on while it is unplugged. Its periods
// begin with the first stream that is started and never stop.
class Sensor {
 public:
  // on_plug is called when it is plugged in (true) or unplugged by a fault.
  Sensor(std::string path, std::function<void(bool)> on_plug);
  ~Sensor();

  // Reads the description, renders and takes the sensor for this process alone. Throws
  // std::runtime_error or std::invalid_argument that says why that cannot be.
  void Open();
  void Close();

  void Start(SensorStream* stream);
  void Stop(SensorStream* stream);  // Receive has returned and is not called any more

  const SyntheticSensor& description() const { return description_; }
  const RenderedImages& images() const { return images_; }

 private:
  void Live();
  void LivePeriod(int64_t n);

  const std::string path_;
  const std::function<void(bool)> on_plug_;
  SyntheticSensor description_;
  RenderedImages images_;
  int lock_fd_ = -1;
  bool is_plugged_ = true;

  std::mutex mutex_;
  bool is_ending_ = false;
  std::set<SensorStream*> started_;
  std::thread thread_;
};

}  // namespace declutter
