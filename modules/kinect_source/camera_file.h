#pragma once

#include <array>
#include <filesystem>
#include <optional>

#include "modules/geometry/depth_image.h"

namespace declutter {

// Lens distortion k1, k2, p1, p2, k3 of the model that ROS calls plumb_bob and OpenCV uses by
// default: where the ray (x, y, 1) is really seen.
using Distortion = std::array<double, 5>;

// A camera as written in a scene.json, an intrinsics file or a calibration file.
struct CameraFile {
  PinholeCamera camera;
  std::optional<double> depth_scale_m;  // [m] per count
  Distortion distortion{};              // all 0: none
};

// Reads a JSON object with width, height, fx, fy, cx, cy and, when it is there, depth_scale_m; or,
// when the name ends in .yaml or .yml, a calibration as ROS (camera_info) and OpenCV write it:
// image_width, image_height, camera_matrix and, when they are there, distortion_coefficients. All
// other keys are ignored. Throws std::runtime_error that names the file and what is wrong with it.
CameraFile ReadCameraFile(const std::filesystem::path& path);

}  // namespace declutter
