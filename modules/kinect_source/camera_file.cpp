#include "modules/kinect_source/camera_file.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <ios>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "modules/geometry/image_limits.h"

namespace declutter {
namespace {

using nlohmann::json;

constexpr double kMaxCenterPx = 4 * kMaxImageSide_px;
constexpr double kMaxFocalLengthPx = 1e6;
constexpr double kMaxDepthScaleM = 1;
constexpr double kMaxDistortion = 100;

[[noreturn]] void Throw(const std::filesystem::path& path, const std::string& what) {
  throw std::runtime_error(path.string() + ": " + what);
}

void CheckRange(const std::filesystem::path& path, const std::string& key, double number,
                double min, double max) {
  if (number >= min && number <= max) return;
  std::ostringstream text;
  text << key << " = " << number << " outside [" << min << ", " << max << "]";
  Throw(path, text.str());
}

void CheckCamera(const std::filesystem::path& path, const CameraFile& file) {
  CheckRange(path, "fx", file.camera.fx, 1, kMaxFocalLengthPx);
  CheckRange(path, "fy", file.camera.fy, 1, kMaxFocalLengthPx);
  CheckRange(path, "cx", file.camera.cx, -kMaxCenterPx, kMaxCenterPx);
  CheckRange(path, "cy", file.camera.cy, -kMaxCenterPx, kMaxCenterPx);
  for (const double k : file.distortion) {
    CheckRange(path, "distortion coefficient", k, -kMaxDistortion, kMaxDistortion);
  }
}

int WholeSide(const std::filesystem::path& path, const std::string& key, double side) {
  CheckRange(path, key, side, 1, kMaxImageSide_px);
  if (side != std::floor(side)) Throw(path, key + " is not a whole number");
  return static_cast<int>(side);
}

json ReadJsonObject(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) Throw(path, std::strerror(errno));
  json object;
  try {
    object = json::parse(file);
  } catch (const json::exception& error) {
    // what() begins with the name of the exception in brackets.
    const std::string text = error.what();
    Throw(path, "not JSON: " + text.substr(text.find("] ") + 2));
  } catch (const std::ios_base::failure& error) {  // opens, but is a folder
    Throw(path, error.code().message());
  }
  if (!object.is_object()) Throw(path, "not a JSON object");
  return object;
}

double Number(const std::filesystem::path& path, const json& object, const char* key) {
  if (!object.contains(key)) Throw(path, std::string(key) + " is missing");
  const json& value = object[key];
  if (!value.is_number()) Throw(path, std::string(key) + " is not a number");
  return value.get<double>();
}

CameraFile ReadJson(const std::filesystem::path& path) {
  const json object = ReadJsonObject(path);
  CameraFile file;
  file.camera.width = WholeSide(path, "width", Number(path, object, "width"));
  file.camera.height = WholeSide(path, "height", Number(path, object, "height"));
  file.camera.fx = Number(path, object, "fx");
  file.camera.fy = Number(path, object, "fy");
  file.camera.cx = Number(path, object, "cx");
  file.camera.cy = Number(path, object, "cy");
  if (object.contains("depth_scale_m")) {
    file.depth_scale_m = Number(path, object, "depth_scale_m");
    CheckRange(path, "depth_scale_m", *file.depth_scale_m, 1e-6, kMaxDepthScaleM);
  }
  return file;
}

double Number(const std::filesystem::path& path, const YAML::Node& document, const char* key) {
  if (!document[key]) Throw(path, std::string(key) + " is missing");
  try {
    return document[key].as<double>();
  } catch (const YAML::Exception&) {
    Throw(path, std::string(key) + " is not a number");
  }
}

std::vector<double> Matrix(const std::filesystem::path& path, const YAML::Node& document,
                           const char* key) {
  const YAML::Node& node = document[key];
  if (!node) Throw(path, std::string(key) + " is missing");
  try {
    return node["data"].as<std::vector<double>>();
  } catch (const YAML::Exception&) {
    Throw(path, std::string(key) + " has no data that are numbers");
  }
}

CameraFile ReadYaml(const std::filesystem::path& path) {
  YAML::Node document;
  try {
    document = YAML::LoadFile(path);
  } catch (const YAML::BadFile&) {
    Throw(path, "cannot be read");
  } catch (const YAML::Exception& error) {
    Throw(path, std::string("not YAML: ") + error.what());
  }
  if (!document.IsMap()) Throw(path, "not a calibration");
  CameraFile file;
  file.camera.width = WholeSide(path, "image_width", Number(path, document, "image_width"));
  file.camera.height = WholeSide(path, "image_height", Number(path, document, "image_height"));
  const std::vector<double> k = Matrix(path, document, "camera_matrix");
  if (k.size() != 9)
    Throw(path, "camera_matrix has " + std::to_string(k.size()) + " numbers, not 9");
  file.camera.fx = k[0];
  file.camera.cx = k[2];
  file.camera.fy = k[4];
  file.camera.cy = k[5];
  if (!document["distortion_coefficients"]) return file;
  const std::vector<double> d = Matrix(path, document, "distortion_coefficients");
  if (d.size() > file.distortion.size()) {
    Throw(path, "distortion_coefficients: " + std::to_string(d.size()) +
                    ", at most k1, k2, p1, p2, k3 are known");
  }
  std::copy(d.begin(), d.end(), file.distortion.begin());
  return file;
}

}  // namespace

CameraFile ReadCameraFile(const std::filesystem::path& path) {
  const bool is_yaml = path.extension() == ".yaml" || path.extension() == ".yml";
  const CameraFile file = is_yaml ? ReadYaml(path) : ReadJson(path);
  CheckCamera(path, file);
  return file;
}

}  // namespace declutter
