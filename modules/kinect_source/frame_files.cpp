#include "modules/kinect_source/frame_files.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <ios>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "modules/geometry/image_limits.h"
#include "modules/imaging/png_file.h"

namespace declutter {
namespace {

using nlohmann::json;

constexpr double kMaxCenterPx = 4 * kMaxImageSide_px;
constexpr double kMaxFocalLengthPx = 1e6;
constexpr double kMaxDepthScaleM = 1;

[[noreturn]] void Throw(const std::filesystem::path& path, const std::string& what) {
  throw std::runtime_error(path.string() + ": " + what);
}

std::string SizeText(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height) + " px";
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

double Number(const std::filesystem::path& path, const json& object, const char* key, double min,
              double max) {
  if (!object.contains(key)) Throw(path, std::string(key) + " is missing");
  const json& value = object[key];
  if (!value.is_number()) Throw(path, std::string(key) + " is not a number");
  const double number = value.get<double>();
  if (!(number >= min && number <= max)) {
    std::ostringstream text;
    text << key << " = " << value << " outside [" << min << ", " << max << "]";
    Throw(path, text.str());
  }
  return number;
}

int Side(const std::filesystem::path& path, const json& object, const char* key) {
  const double side = Number(path, object, key, 1, kMaxImageSide_px);
  if (side != std::floor(side)) Throw(path, std::string(key) + " is not a whole number");
  return static_cast<int>(side);
}

}  // namespace

CameraFile ReadCameraFile(const std::filesystem::path& path) {
  const json object = ReadJsonObject(path);
  CameraFile file;
  file.camera.width = Side(path, object, "width");
  file.camera.height = Side(path, object, "height");
  file.camera.fx = Number(path, object, "fx", 1, kMaxFocalLengthPx);
  file.camera.fy = Number(path, object, "fy", 1, kMaxFocalLengthPx);
  file.camera.cx = Number(path, object, "cx", -kMaxCenterPx, kMaxCenterPx);
  file.camera.cy = Number(path, object, "cy", -kMaxCenterPx, kMaxCenterPx);
  if (object.contains("depth_scale_m")) {
    file.depth_scale_m = Number(path, object, "depth_scale_m", 1e-6, kMaxDepthScaleM);
  }
  return file;
}

DepthImage ReadDepthImage(const std::filesystem::path& path, const PinholeCamera& camera,
                          double depth_scale_m) {
  auto image = imaging::ReadGray16Png(path.string());
  if (image.width != camera.width || image.height != camera.height) {
    Throw(path, SizeText(image.width, image.height) + ", but the intrinsics are for " +
                    SizeText(camera.width, camera.height));
  }
  return {camera, depth_scale_m, std::move(image.pixels)};
}

void ReadColorImage(const std::filesystem::path& path, FrameContent* content) {
  try {
    ColorImage image = imaging::ReadRgbPng(path.string());
    const PinholeCamera& camera = content->depth.camera;
    if (image.width != camera.width || image.height != camera.height) {
      Throw(path, SizeText(image.width, image.height) + ", but the depth image has " +
                      SizeText(camera.width, camera.height));
    }
    content->color = std::move(image);
  } catch (const std::runtime_error& error) {
    content->color_error = error.what();
  }
}

}  // namespace declutter
