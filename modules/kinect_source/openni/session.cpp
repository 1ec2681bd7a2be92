#include "modules/kinect_source/openni/session.h"

#include <OpenNI.h>
#include <dlfcn.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "modules/kinect_source/openni/openni_error.h"
#include "modules/kinect_source/openni/openni_sensor.h"

namespace declutter {
namespace {

const std::string kSerialPrefix = "serial=";

std::string SerialOf(const openni::Device& device) {
  char serial[ONI_MAX_STR] = "";
  int size = sizeof(serial);
  if (device.getProperty(openni::DEVICE_PROPERTY_SERIAL_NUMBER, serial, &size) != openni::STATUS_OK)
    return "";
  return serial;
}

std::string Names(const std::vector<ListedSensor>& sensors) {
  std::string text;
  for (const ListedSensor& sensor : sensors) {
    text += (text.empty() ? "" : ", ") + sensor.uri;
    if (!sensor.serial.empty()) text += " (serial " + sensor.serial + ")";
    if (!sensor.trouble.empty()) text += " (" + sensor.trouble + ")";
  }
  return text.empty() ? "none" : text;
}

}  // namespace

OpenniSession::OpenniSession() {
  if (openni::OpenNI::initialize() != openni::STATUS_OK) {
    throw NoSensor("OpenNI2 cannot be used: " + OpenniError());
  }
}

OpenniSession::~OpenniSession() { openni::OpenNI::shutdown(); }

std::unique_ptr<Sensor> OpenniSession::Open(const SensorRequest& request) const {
  return std::make_unique<OpenniSensor>(UriOf(request.device), request);
}

std::string OpenniSession::UriOf(const std::string& device) const {
  const bool by_serial = device.rfind(kSerialPrefix, 0) == 0;
  if (!device.empty() && !by_serial) return device;
  const std::vector<ListedSensor> sensors = List();
  const std::string serial = by_serial ? device.substr(kSerialPrefix.size()) : "";
  for (const ListedSensor& sensor : sensors) {
    if (sensor.trouble.empty() && (!by_serial || sensor.serial == serial)) return sensor.uri;
  }
  throw NoSensor(
      (by_serial ? "no sensor with serial number " + serial : "no sensor can be opened") +
      "; connected: " + Names(sensors) + "; list_sensors tells more");
}

std::vector<ListedSensor> OpenniSession::List() const {
  openni::Array<openni::DeviceInfo> infos;
  openni::OpenNI::enumerateDevices(&infos);
  std::vector<ListedSensor> sensors;
  for (int i = 0; i < infos.getSize(); ++i) {
    const std::string uri = infos[i].getUri();
    ListedSensor sensor{uri, std::string(infos[i].getVendor()) + " " + infos[i].getName(), "", ""};
    openni::Device device;
    if (device.open(uri.c_str()) == openni::STATUS_OK) {
      sensor.serial = SerialOf(device);
    } else {
      sensor.trouble = OpenniError();
    }
    sensors.push_back(sensor);
  }
  return sensors;
}

std::vector<std::string> OpenniSession::Drivers() {
  Dl_info library{};
  std::vector<std::string> drivers;
  if (dladdr(reinterpret_cast<void*>(&oniInitialize), &library) == 0) return drivers;
  const auto folder = std::filesystem::path(library.dli_fname).parent_path() / "OpenNI2/Drivers";
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    drivers.push_back(entry.path());
  }
  std::sort(drivers.begin(), drivers.end());
  return drivers;
}

}  // namespace declutter
