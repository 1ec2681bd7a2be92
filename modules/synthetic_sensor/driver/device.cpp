#include "modules/synthetic_sensor/driver/device.h"

#include <algorithm>

#include "modules/synthetic_sensor/driver/stream.h"

namespace declutter {

Device::Device(Sensor* sensor)
    : sensor_(sensor),
      depth_modes_(Stream::Modes(ONI_SENSOR_DEPTH, *sensor)),
      color_modes_(Stream::Modes(ONI_SENSOR_COLOR, *sensor)) {
  streams_ = {{ONI_SENSOR_DEPTH, static_cast<int>(depth_modes_.size()), depth_modes_.data()},
              {ONI_SENSOR_COLOR, static_cast<int>(color_modes_.size()), color_modes_.data()}};
}

Device::~Device() { sensor_->Close(); }

OniStatus Device::getSensorInfoList(OniSensorInfo** sensors, int* num_sensors) {
  *sensors = streams_.data();
  *num_sensors = static_cast<int>(streams_.size());
  return ONI_STATUS_OK;
}

oni::driver::StreamBase* Device::createStream(OniSensorType type) {
  const auto is_type = [type](const OniSensorInfo& info) { return info.sensorType == type; };
  if (std::none_of(streams_.begin(), streams_.end(), is_type)) return nullptr;
  return new Stream(type, sensor_);
}

void Device::destroyStream(oni::driver::StreamBase* stream) { delete stream; }

OniBool Device::isPropertySupported(int id) {
  return id == ONI_DEVICE_PROPERTY_SERIAL_NUMBER || id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION;
}

OniStatus Device::getProperty(int id, void* data, int* size) {
  if (id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION) return GetProperty(registration_, data, size);
  if (id != ONI_DEVICE_PROPERTY_SERIAL_NUMBER) return ONI_STATUS_NOT_SUPPORTED;
  const std::string& serial = sensor_->description().serial();
  const int length = static_cast<int>(serial.size()) + 1;
  if (*size < length) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(data, serial.c_str(), static_cast<size_t>(length));
  *size = length;
  return ONI_STATUS_OK;
}

OniStatus Device::setProperty(int id, const void* data, int size) {
  if (id != ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION) return ONI_STATUS_NOT_SUPPORTED;
  OniImageRegistrationMode mode = ONI_IMAGE_REGISTRATION_OFF;
  const OniStatus status = SetProperty(data, size, &mode);
  if (status != ONI_STATUS_OK) return status;
  if (!isImageRegistrationModeSupported(mode)) return ONI_STATUS_NOT_SUPPORTED;
  registration_ = mode;
  return ONI_STATUS_OK;
}

OniBool Device::isImageRegistrationModeSupported(OniImageRegistrationMode mode) {
  return mode == ONI_IMAGE_REGISTRATION_OFF || sensor_->description().can_register();
}

}  // namespace declutter
