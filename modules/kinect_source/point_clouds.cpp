#include "modules/kinect_source/point_clouds.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "modules/kinect_source/camera_file.h"
#include "modules/kinect_source/file_listing.h"
#include "modules/kinect_source/frame_files.h"
#include "modules/kinect_source/pcd_file.h"
#include "modules/kinect_source/pinhole_fit.h"

namespace declutter {
namespace {

namespace fs = std::filesystem;

using OptionalCamera = std::optional<PinholeCamera>;

// `pixels` are those of the grid.
PinholeCamera GridCamera(const PointCloudFile& cloud, const std::vector<int>& pixels,
                         const OptionalCamera& given) {
  const bool is_blind = std::all_of(pixels.begin(), pixels.end(), [](int p) { return p < 0; });
  if (is_blind && given && given->width == cloud.width && given->height == cloud.height) {
    return *given;
  }
  return FitPinholeCamera(cloud.width, cloud.height, cloud.points);
}

std::optional<ColorImage> ColorOf(const PointCloudFile& cloud, const PinholeCamera& camera,
                                  const std::vector<int>& pixels) {
  if (cloud.colors.empty()) return std::nullopt;
  ColorImage image{camera.width, camera.height,
                   std::vector<uint8_t>(size_t{3} * static_cast<size_t>(camera.num_pixels()))};
  for (size_t i = 0; i < pixels.size(); ++i) {
    if (pixels[i] < 0) continue;
    const uint32_t packed = cloud.colors[i];
    uint8_t* rgb = &image.rgb[3 * static_cast<size_t>(pixels[i])];
    rgb[0] = static_cast<uint8_t>(packed >> 16 & 0xFF);
    rgb[1] = static_cast<uint8_t>(packed >> 8 & 0xFF);
    rgb[2] = static_cast<uint8_t>(packed & 0xFF);
  }
  return image;
}

FrameContent ImagesOfGrid(const PointCloudFile& cloud, const OptionalCamera& given) {
  const std::vector<int> pixels = GridPixels(cloud.points);
  const PinholeCamera camera = GridCamera(cloud, pixels, given);
  // Points have a colour even where nothing was measured.
  std::vector<int> all_pixels(cloud.points.size());
  std::iota(all_pixels.begin(), all_pixels.end(), 0);
  return {DepthOf(camera, cloud.points, pixels), ColorOf(cloud, camera, all_pixels), ""};
}

FrameContent ImagesOf(const PointCloudFile& cloud, const OptionalCamera& given) {
  if (cloud.is_organised()) return ImagesOfGrid(cloud, given);
  if (!given) {
    throw std::runtime_error(
        "not organised (height 1) and its camera is not known: set intrinsics_file or put "
        "intrinsics.json beside it");
  }
  const std::vector<int> pixels = ProjectedPixels(*given, cloud.points);
  return {DepthOf(*given, cloud.points, pixels), ColorOf(cloud, *given, pixels), ""};
}

FrameContent LoadCloud(const fs::path& path, const OptionalCamera& given) {
  const PointCloudFile cloud = ReadPcdFile(path);
  try {
    return ImagesOf(cloud, given);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
}

}  // namespace

std::vector<RecordingEntry> ListPointClouds(const fs::path& input,
                                            const std::string& intrinsics_file) {
  OptionalCamera camera;
  const fs::path intrinsics_path = IntrinsicsPath(input, intrinsics_file);
  const std::vector<fs::path> paths = ListFiles(input, ".pcd");
  if (!paths.empty() && (!intrinsics_file.empty() || fs::exists(intrinsics_path))) {
    try {
      camera = ReadCameraFile(intrinsics_path).camera;
    } catch (const std::runtime_error& error) {
      throw std::invalid_argument(error.what());
    }
  }
  std::vector<RecordingEntry> entries;
  for (const fs::path& path : paths) {
    entries.push_back({path.stem().string(), static_cast<int64_t>(entries.size()) * kFramePeriodUs,
                       [path, camera] { return LoadCloud(path, camera); }});
  }
  return entries;
}

}  // namespace declutter
