#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace declutter {

// A depth camera on the USB, whether OpenNI2 can use it or not.
struct UsbSensor {
  std::string name;     // "Kinect (USB 045e:02ae)"
  std::string trouble;  // what keeps OpenNI2 from using it, and the mend; empty: nothing
};

// Depth cameras among the devices of the kernel's list `devices` (/sys/bus/usb/devices), whose
// nodes are below `nodes` (/dev/bus/usb). drivers: file names of OpenNI2's drivers.
std::vector<UsbSensor> FindUsbSensors(const std::filesystem::path& devices,
                                      const std::filesystem::path& nodes,
                                      const std::vector<std::string>& drivers);

}  // namespace declutter
