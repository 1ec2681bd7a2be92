// list_sensors: which drivers and sensors OpenNI2 finds, and why one cannot be used.
#include <cstdio>
#include <exception>
#include <filesystem>

#include "modules/kinect_source/openni/session.h"
#include "modules/kinect_source/openni/usb_sensors.h"

namespace {

constexpr char kUsage[] =
    "usage: list_sensors\n"
    "Prints a line for each driver of OpenNI2 (driver FILE), each sensor that it finds (sensor "
    "URI\n"
    "NAME), and each depth camera on the USB that it cannot use (unusable NAME: why). Ends with 0\n"
    "when there is a sensor that can be opened, 1 when there is none, 2 on wrong use.\n";

// Whether there is a sensor that can be opened.
bool List() {
  using namespace declutter;
  const std::vector<std::string> drivers = OpenniSession::Drivers();
  for (const std::string& driver : drivers) {
    std::printf("driver %s\n", std::filesystem::path(driver).filename().c_str());
  }
  bool is_any_usable = false;
  const OpenniSession session;
  for (const ListedSensor& sensor : session.List()) {
    std::printf("sensor %s %s%s%s%s%s\n", sensor.uri.c_str(), sensor.name.c_str(),
                sensor.serial.empty() ? "" : ", serial ", sensor.serial.c_str(),
                sensor.trouble.empty() ? "" : ": cannot be opened: ", sensor.trouble.c_str());
    is_any_usable = is_any_usable || sensor.trouble.empty();
  }
  for (const UsbSensor& sensor : FindUsbSensors("/sys/bus/usb/devices", "/dev/bus/usb", drivers)) {
    if (sensor.trouble.empty()) continue;
    std::printf("unusable %s: %s\n", sensor.name.c_str(), sensor.trouble.c_str());
  }
  return is_any_usable;
}

}  // namespace

int main(int argc, char**) {
  if (argc > 1) {
    std::fputs(kUsage, stderr);
    return 2;
  }
  try {
    return List() ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "list_sensors: %s\n", error.what());
    return 1;
  }
}
