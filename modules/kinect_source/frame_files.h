#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "modules/geometry/depth_image.h"
#include "modules/kinect_source/recording_entry.h"

// The files that a frame is made of. All functions throw std::runtime_error that names the file and
// what is wrong with it.
namespace declutter {

// Reads a 16-bit grey PNG, which must have the size of `camera`.
DepthImage ReadDepthImage(const std::filesystem::path& path, const PinholeCamera& camera,
                          double depth_scale_m);

// Reads a colour image into content.color. One that cannot be read, or has another size than the
// depth image, does not spoil the frame: content.color_error says why it is missing.
void ReadColorImage(const std::filesystem::path& path, FrameContent* content);

}  // namespace declutter
