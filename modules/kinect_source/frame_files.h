#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "modules/geometry/depth_image.h"
#include "modules/kinect_source/recording_entry.h"

// The files that a frame is made of. All functions throw std::runtime_error that names the file and
// what is wrong with it.
namespace declutter {

// A camera as written in a scene.json or an intrinsics file.
struct CameraFile {
  PinholeCamera camera;
  std::optional<double> depth_scale_m;  // [m] per count
};

// Reads width, height, fx, fy, cx, cy and, when it is there, depth_scale_m from a JSON object; all
// other keys are ignored.
CameraFile ReadCameraFile(const std::filesystem::path& path);

// Reads a 16-bit grey PNG, which must have the size of `camera`.
DepthImage ReadDepthImage(const std::filesystem::path& path, const PinholeCamera& camera,
                          double depth_scale_m);

// Reads a colour image into content.color. One that cannot be read, or has another size than the
// depth image, does not spoil the frame: content.color_error says why it is missing.
void ReadColorImage(const std::filesystem::path& path, FrameContent* content);

}  // namespace declutter
