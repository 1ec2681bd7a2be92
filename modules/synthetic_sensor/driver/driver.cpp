#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>

#include "modules/synthetic_sensor/driver/device.h"

namespace declutter {
namespace {

const std::string kPrefix = "synthetic:";
// A sensor file whose device is listed from the start, as one on the USB would be; others are found
// when they are opened by their URI.
constexpr const char* kListedVariable = "DECLUTTER_SYNTHETIC_SENSOR";

OniDeviceInfo InfoOf(const std::string& uri) {
  OniDeviceInfo info{};
  std::snprintf(info.uri, sizeof(info.uri), "%s", uri.c_str());
  std::snprintf(info.vendor, sizeof(info.vendor), "declutter");
  std::snprintf(info.name, sizeof(info.name), "synthetic sensor");
  return info;
}

// Devices with the URI synthetic:FILE, where FILE describes the sensor.
class Driver : public oni::driver::DriverBase {
 public:
  explicit Driver(OniDriverServices* services) : DriverBase(services) {}

  OniStatus initialize(oni::driver::DeviceConnectedCallback connected,
                       oni::driver::DeviceDisconnectedCallback disconnected,
                       oni::driver::DeviceStateChangedCallback changed, void* cookie) override {
    const OniStatus status = DriverBase::initialize(connected, disconnected, changed, cookie);
    const char* listed = std::getenv(kListedVariable);
    if (status == ONI_STATUS_OK && listed != nullptr) Plug(kPrefix + listed);
    return status;
  }

  OniStatus tryDevice(const char* uri) override {
    if (std::string(uri).rfind(kPrefix, 0) != 0) return ONI_STATUS_ERROR;
    if (sensors_.count(uri) == 0) Plug(uri);
    return ONI_STATUS_OK;
  }

  oni::driver::DeviceBase* deviceOpen(const char* uri, const char*) override {
    Sensor& sensor = *sensors_.at(uri);
    try {
      sensor.Open();
      return new Device(&sensor);
    } catch (const std::exception& error) {
      getServices().errorLoggerAppend("%s", error.what());
      return nullptr;
    }
  }

  void deviceClose(oni::driver::DeviceBase* device) override { delete device; }

  void shutdown() override { sensors_.clear(); }

 private:
  void Plug(const std::string& uri) {
    const auto on_plug = [this, uri](bool is_plugged) {
      const OniDeviceInfo info = InfoOf(uri);
      is_plugged ? deviceConnected(&info) : deviceDisconnected(&info);
    };
    sensors_.emplace(uri, std::make_unique<Sensor>(uri.substr(kPrefix.size()), on_plug));
    on_plug(true);
  }

  std::map<std::string, std::unique_ptr<Sensor>> sensors_;
};

}  // namespace
}  // namespace declutter

ONI_EXPORT_DRIVER(declutter::Driver)
