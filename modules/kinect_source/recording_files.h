#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "modules/imaging/png_file.h"

// Small recordings for tests.
namespace declutter {

inline constexpr const char* kCamera3x2 =
    R"({"width": 3, "height": 2, "fx": 500, "fy": 501, "cx": 1, "cy": 0.5, "depth_scale_m": 0.001})";

inline void WriteText(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path) << text;
}

inline void WriteDepth3x2(const std::filesystem::path& path, uint16_t count) {
  std::filesystem::create_directories(path.parent_path());
  imaging::WriteGray16Png(path.string(), {3, 2, std::vector<uint16_t>(6, count)});
}

inline void WriteColor3x2(const std::filesystem::path& path, uint8_t red) {
  std::filesystem::create_directories(path.parent_path());
  ColorImage image{3, 2, std::vector<uint8_t>(18)};
  for (size_t i = 0; i < image.rgb.size(); i += 3) image.rgb[i] = red;
  imaging::WriteRgbPng(path.string(), image);
}

inline void WriteScene(const std::filesystem::path& folder, uint16_t count) {
  WriteText(folder / "scene.json", kCamera3x2);
  WriteDepth3x2(folder / "depth.png", count);
}

}  // namespace declutter
