#pragma once

#include <vector>

#include "modules/synthetic_sensor/driver/driver_api.h"
#include "modules/synthetic_sensor/driver/sensor.h"

namespace declutter {

// The depth or the colour stream of a device.
class Stream : public oni::driver::StreamBase, public SensorStream {
 public:
  Stream(OniSensorType type, Sensor* sensor);
  ~Stream() override;

  OniStatus start() override;
  void stop() override;
  OniBool isPropertySupported(int id) override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniStatus setProperty(int id, const void* data, int size) override;
  void notifyAllProperties() override;

  void Receive(const SensorOutput& output) override;

  // What a stream of this type of the sensor can show: all its pixels, or half the columns and
  // rows.
  static std::vector<OniVideoMode> Modes(OniSensorType type, const Sensor& sensor);

 private:
  OniStatus SetMode(const OniVideoMode& mode);
  OniStatus SetCropping(const OniCropping& cropping);
  int Stride() const;
  float FieldOfView(bool is_horizontal) const;
  ImageWindow Window() const;
  void Notify(int id, const void* data, int size);

  const OniSensorType type_;
  Sensor* const sensor_;
  OniVideoMode mode_;
  OniCropping cropping_{};
  bool is_started_ = false;
  OniBool is_mirrored_ = TRUE;  // as real ones are until told
  OniBool auto_exposure_ = TRUE;
  OniBool auto_white_balance_ = TRUE;
};

}  // namespace declutter
