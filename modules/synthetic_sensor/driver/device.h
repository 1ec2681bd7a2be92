#pragma once

#include <vector>

#include "modules/synthetic_sensor/driver/driver_api.h"
#include "modules/synthetic_sensor/driver/sensor.h"

namespace declutter {

// A sensor while it is open.
class Device : public oni::driver::DeviceBase {
 public:
  explicit Device(Sensor* sensor);
  ~Device() override;

  OniStatus getSensorInfoList(OniSensorInfo** sensors, int* num_sensors) override;
  oni::driver::StreamBase* createStream(OniSensorType type) override;
  void destroyStream(oni::driver::StreamBase* stream) override;
  OniBool isPropertySupported(int id) override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniStatus setProperty(int id, const void* data, int size) override;
  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode mode) override;

 private:
  Sensor* const sensor_;
  std::vector<OniVideoMode> depth_modes_;
  std::vector<OniVideoMode> color_modes_;
  std::vector<OniSensorInfo> streams_;
  OniImageRegistrationMode registration_ = ONI_IMAGE_REGISTRATION_OFF;
};

}  // namespace declutter
