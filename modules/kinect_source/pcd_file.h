#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace declutter {

// The positions and colours of a point cloud file.
struct PointCloudFile {
  int width = 0;   // points of a row; of the whole cloud when it is not organised
  int height = 0;  // 1 when the cloud is not organised
  std::vector<Eigen::Vector3f> points;  // row-major; not finite where nothing was measured
  std::vector<uint32_t> colors;         // 0xAARRGGBB; empty when the file has none

  bool is_organised() const { return height > 1; }
};

// Reads a .pcd file of the Point Cloud Library: ascii, binary or binary_compressed, with x, y, z as
// 32-bit floats and rgb or rgba as any 32-bit type; other fields are skipped. Nothing in the file
// is believed unchecked. Throws std::runtime_error that names the file and what is wrong with it.
PointCloudFile ReadPcdFile(const std::filesystem::path& path);

}  // namespace declutter
