#include "modules/kinect_source/openni/usb_sensors.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <optional>

namespace declutter {
namespace {

namespace fs = std::filesystem;

struct Model {
  const char* vendor;
  const char* product;  // empty: all of the vendor
  const char* name;
  const char* driver;  // beginning of the file name of its driver
};

constexpr Model kModels[] = {
    {"045e", "02ae", "Kinect", "libFreenectDriver"},
    {"045e", "02bf", "Kinect for Windows", "libFreenectDriver"},
    {"1d27", "0600", "PrimeSense sensor", "libPS1080"},
    {"1d27", "0601", "PrimeSense sensor", "libPS1080"},
    {"1d27", "0609", "PrimeSense sensor", "libPS1080"},
    {"1d27", "", "PrimeSense sensor", "libPSLink"},
    {"2bc5", "", "Orbbec sensor", "liborbbec"},
};

std::string FirstWord(const fs::path& path) {
  std::ifstream file(path);
  std::string word;
  file >> word;
  return word;
}

const Model* ModelOf(const std::string& vendor, const std::string& product) {
  for (const Model& model : kModels) {
    if (vendor == model.vendor && (*model.product == '\0' || product == model.product)) {
      return &model;
    }
  }
  return nullptr;
}

// nodes/001/004
fs::path NodeOf(const fs::path& device, const fs::path& nodes) {
  const auto number = [&device](const char* file) {
    const std::string digits = FirstWord(device / file);
    return std::string(3 - std::min<size_t>(3, digits.size()), '0') + digits;
  };
  return nodes / number("busnum") / number("devnum");
}

std::string TroubleOf(const Model& model, const fs::path& node,
                      const std::vector<std::string>& drivers) {
  const auto is_its_driver = [&model](const std::string& driver) {
    return fs::path(driver).filename().string().rfind(model.driver, 0) == 0;
  };
  if (std::none_of(drivers.begin(), drivers.end(), is_its_driver)) {
    return std::string("needs the OpenNI2 driver ") + model.driver +
           ".so.0: see 'Live sensors' in README.md";
  }
  if (access(node.c_str(), R_OK | W_OK) != 0) {
    return "no right to use " + node.string() + ": see 'Live sensors' in README.md for a udev rule";
  }
  return "";
}

}  // namespace

std::vector<UsbSensor> FindUsbSensors(const fs::path& devices, const fs::path& nodes,
                                      const std::vector<std::string>& drivers) {
  std::vector<UsbSensor> sensors;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(devices, error)) {
    const std::string vendor = FirstWord(entry.path() / "idVendor");
    const std::string product = FirstWord(entry.path() / "idProduct");
    const Model* model = ModelOf(vendor, product);
    if (model == nullptr) continue;
    sensors.push_back({std::string(model->name) + " (USB " + vendor + ":" + product + ")",
                       TroubleOf(*model, NodeOf(entry.path(), nodes), drivers)});
  }
  std::sort(sensors.begin(), sensors.end(),
            [](const UsbSensor& a, const UsbSensor& b) { return a.name < b.name; });
  return sensors;
}

}  // namespace declutter
