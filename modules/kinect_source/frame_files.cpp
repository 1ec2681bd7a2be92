#include "modules/kinect_source/frame_files.h"

#include <stdexcept>
#include <utility>

#include "modules/imaging/png_file.h"

namespace declutter {
namespace {

[[noreturn]] void Throw(const std::filesystem::path& path, const std::string& what) {
  throw std::runtime_error(path.string() + ": " + what);
}

std::string SizeText(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height) + " px";
}

}  // namespace

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
